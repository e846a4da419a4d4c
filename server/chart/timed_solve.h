#pragma once

#include "solver/solve_scene.h"

namespace patchlight::server {

struct TimedSolution {
    Solution solution;
    double seconds = 0.0;         // without what it took to measure errors for the report alone
    bool is_out_of_time = false;  // ended by its time limit
    bool is_finite = true;        // every number that is displayed
};

/// Solves within so many seconds. Throws what solve_scene throws.
TimedSolution solve_timed(const Scene& scene, SolveSettings settings, double time_limit,
                          const Observer& observe);

}  // namespace patchlight::server
