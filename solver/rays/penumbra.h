#pragma once

#include "solver/scene/scene.h"

#include <span>
#include <vector>

namespace patchlight {

/// First visibility samples of one target: which plane or surface it is on, how many were clear.
struct FirstLook {
    std::uint32_t sheet = 0;
    int clear = 0;
    int taken = 0;
};

/// Which targets deserve many more samples, told by those beside them in the list alone. To ask a
/// target's own samples would bias the result: of targets one tenth clear, most would look hidden
/// at first and be believed. A target with fewer than two neighbours on its sheet always does.
std::vector<bool> in_penumbra(std::span<const FirstLook> looks);

}  // namespace patchlight
