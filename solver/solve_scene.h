#pragma once

#include "solver/findings/viewpoint.h"
#include "solver/scene/scene.h"
#include "solver/settings.h"
#include "solver/solution.h"

#include <span>
#include <vector>

namespace patchlight {

/// What a solve would cost, known before much is allocated.
struct CostEstimate {
    std::size_t patches = 0;
    std::uint64_t memory = 0;        // peak [bytes]
    std::uint64_t memory_limit = 0;  // a solve that would need more is refused [bytes]
    double seconds = 0.0;            // on two cores, order of magnitude
};

/// Throws InputError("/solve/...") if a setting asks for what cannot be done.
CostEstimate estimate_cost(const Scene& scene, const SolveSettings& settings);

/// What the author of the scene should know, before anything is solved; of `viewpoints`, those that
/// lie in a solid or outside the room.
std::vector<Finding> find_flaws(const Scene& scene, const SolveSettings& settings,
                                std::span<const Viewpoint> viewpoints = {});

/// Solves the radiosity equation B = E + ρ F B of the scene.
/// Throws InputError if a setting asks for what cannot be done, if a reflectance is not in [0, 1)
/// or an exitance not finite, or if the estimate exceeds `memory_limit` (the message carries both
/// numbers). Reaching a limit, or the observer's `stop`,
/// is told by `status`, with the solution so far. `viewpoints` as above.
Solution solve_scene(const Scene& scene, const SolveSettings& settings, const Observer& observe,
                     std::span<const Viewpoint> viewpoints = {});

}  // namespace patchlight
