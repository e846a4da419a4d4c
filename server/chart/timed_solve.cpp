#include "server/chart/timed_solve.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace patchlight::server {

TimedSolution solve_timed(const Scene& scene, SolveSettings settings, double time_limit,
                          const Observer& observe) {
    settings.time_limit = time_limit;
    const auto start = std::chrono::steady_clock::now();
    TimedSolution timed;
    timed.solution = solve_scene(scene, settings, observe);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
    timed.is_out_of_time =
        timed.solution.status != Status::converged && whole.count() >= time_limit;
    timed.is_finite = std::all_of(timed.solution.display.radiosity.begin(),
                                  timed.solution.display.radiosity.end(),
                                  [](const Rgb& radiosity) { return radiosity.allFinite(); });
    timed.seconds = whole.count() - timed.solution.seconds.measuring;
    return timed;
}

}  // namespace patchlight::server
