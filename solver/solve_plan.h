#pragma once

#include "solver/scene/coplanar.h"
#include "solver/settings.h"
#include "solver/solve_scene.h"

#include <string>

namespace patchlight {

/// The settings with every choice made, and why.
struct SolvePlan {
    SolveSettings settings;
    std::string why;
};

/// Throws InputError("/solve/...") if a setting asks for what cannot be done.
SolvePlan plan_solve(const Scene& scene, const SolveSettings& settings);

/// Peak memory of a solve on so many patches [bytes].
std::uint64_t estimate_memory(const Scene& scene, std::size_t patches,
                              const SolveSettings& planned);

/// Throws InputError naming both numbers if `patches` would need more than the memory limit.
void check_memory(const Scene& scene, std::size_t patches, const SolveSettings& planned);

}  // namespace patchlight
