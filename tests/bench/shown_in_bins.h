#pragma once

#include "solver/solution.h"
#include "tests/bench/bins.h"

#include <vector>

namespace patchlight {

/// Luminance that is displayed as reflected, Y(B̃ - E), over each bin [W].
std::vector<double> shown_in_bins(const Scene& scene, const Solution& solution,
                                  const TracedScene& traced, const Bins& bins);

}  // namespace patchlight
