#pragma once

#include "tests/bench/emission.h"

#include <cstdint>

namespace patchlight {

/// Teaches an emission which of its light comes to use: first light is sent out and sought from
/// where it may land (a spot too small for the one is found by the other), then more is sent where
/// some was found. Lengthens nothing but the odds: what it misses is still launched now and then.
/// A round has so many searches, and a fifth as many launches.
void learn_useful_light(const TracedScene& traced, Emission& emission, std::uint64_t seed,
                        std::size_t searches);

}  // namespace patchlight
