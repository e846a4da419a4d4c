#include "solver/foretell_time.h"

#include "solver/solve_plan.h"
#include "solver/solve_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace patchlight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double enough = 2.0, most = 4.0;  // seconds of trying, as it is set and less tight
/// From an accuracy to one `tighter` times tighter, from 2.5 on, the display takes about so many
/// times `tighter`: from 0.2, 0.08 and 0.05 to 0.02 rooms with furniture and lanterns, a sunbeam,
/// and a city under a sky took 26 to 47, 11 to 16, and 6 to 15 times as long.
constexpr double per_tighter = 3.5;
constexpr std::size_t most_patches = 100'000;  // of more no limit ends a trial in time
constexpr double step = 2.5, loosest = 0.2;    // of accuracies that are tried

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Something that goes from one value to another as time goes on, straight.
struct Course {
    std::optional<double> first_at;
    double first = 0.0, last_at = 0.0, last = 0.0;

    void pass(double seconds, double value) {
        if (!first_at) first_at = seconds, first = value;
        last_at = seconds;
        last = value;
    }
    /// When it comes to `value`; none if it does not move that way.
    std::optional<double> reaches(double value) const {
        if (!first_at || !((last - first) * (value - last) > 0.0)) return std::nullopt;
        return last_at + (last_at - *first_at) * (value - last) / (last - first);
    }
};

struct Trial {
    double seconds = 0.0;
    double display = 0.0;  // of it, after form factors and the coarse solution
    bool ended = false;
    std::optional<double> goes_on_to;  // seconds, where it was still finding form factors or light
};

Trial try_for(const Scene& scene, SolveSettings settings, double limit) {
    const Clock::time_point start = Clock::now();
    Course rows, light;  // fraction, logarithm of the residual
    settings.time_limit = limit;
    const Solution solution = solve_scene(scene, settings, [&](const Progress& progress) {
        if (progress.stage == Stage::form_factors && progress.fraction > 0.0)
            rows.pass(since(start), progress.fraction);
        if (progress.stage == Stage::solve && progress.residual > 0.0)
            light.pass(since(start), std::log(progress.residual));
        return Verdict::go_on;
    });
    Trial trial;
    trial.seconds = since(start);
    // A limit of iterations ends a solve, too; what is measured at the end is left some time.
    trial.ended = solution.status == Status::converged || trial.seconds < 0.8 * limit;
    const StageSeconds& of = solution.seconds;
    trial.display = trial.seconds - std::max(light.last_at, of.mesh + of.form_factors + of.solve);
    const double wanted = std::log(*solution.settings.tolerance);
    if (!trial.ended && light.first_at && light.last > wanted)
        trial.goes_on_to = light.reaches(wanted);
    else if (!trial.ended && !light.first_at && rows.last < 1.0)
        trial.goes_on_to = rows.reaches(1.0);
    return trial;
}

}  // namespace

double foretell_seconds(const Scene& scene, const SolveSettings& settings) {
    const Clock::time_point start = Clock::now();
    const double limit = settings.time_limit.value_or(1e300);
    const CostEstimate cost = estimate_cost(scene, settings);
    if (cost.patches > most_patches) return std::min(cost.seconds, limit);
    const Trial whole = try_for(scene, settings, std::min(limit, enough));
    if (whole.ended || limit <= enough) return std::min(whole.seconds, limit);
    double seconds = std::max(whole.seconds, whole.goes_on_to.value_or(0.0));
    const std::optional<double> target = plan_solve(scene, settings).settings.accuracy;
    if (!target) {
        if (!whole.goes_on_to) seconds = std::max(seconds, cost.seconds);
        return std::min(seconds, limit);
    }
    SolveSettings tried = settings;
    for (tried.accuracy = std::max(loosest, *target); since(start) < enough + most / 2;) {
        const Trial trial = try_for(scene, tried, most + enough - since(start));
        const double tighter = *tried.accuracy / *target;
        const double all = trial.seconds + trial.display * (per_tighter * tighter - 1.0);
        if (trial.ended)  // closer than what less tight ones told
            seconds = std::max(whole.seconds, all);
        else
            seconds = std::max({seconds, all, trial.goes_on_to.value_or(0.0)});
        if (!trial.ended || tighter <= step) break;
        *tried.accuracy /= step;
    }
    return std::min(seconds, limit);
}

}  // namespace patchlight
