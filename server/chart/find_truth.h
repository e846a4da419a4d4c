#pragma once

#include "server/chart/chart_truth.h"

#include <functional>
#include <optional>

namespace patchlight::server {

struct FoundTruth {
    ChartTruth truth;
    double accuracy = 0.0;  // asked for in the solve it comes from [1]
    double seconds = 0.0;   // of that solve
};

/// Solves to accuracy after accuracy, each tighter than the one before, as long as the next is
/// likely to be done within `seconds`, and takes the one that is surest of itself. The first may
/// take up to `first_seconds`, as nothing can be measured without. Random numbers are others than
/// those of the methods it is to judge. `start` is told each accuracy. Empty if not even the first
/// came to an end. Throws what solve_scene throws.
std::optional<FoundTruth> find_truth(const Scene& scene, const SolveSettings& base, double seconds,
                                     double first_seconds, const std::function<void(double)>& start,
                                     const Observer& observe);

}  // namespace patchlight::server
