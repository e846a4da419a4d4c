#include "server/chart/find_truth.h"

#include "server/chart/timed_solve.h"
#include "solver/rays/low_discrepancy.h"

#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace patchlight::server {
namespace {

constexpr std::array accuracies{0.02, 0.01, 0.005, 0.003, 0.002, 0.0015, 0.001, 0.00075};
constexpr double growth = 2.5;  // seconds go as accuracy to minus this: measured, 2 to 3

bool is_surer(const Solution& solution, const Solution& other) {
    if (!solution.error.estimate) return !other.error.estimate;
    return !other.error.estimate || *solution.error.estimate < *other.error.estimate;
}

}  // namespace

std::optional<FoundTruth> find_truth(const Scene& scene, const SolveSettings& base, double seconds,
                                     double first_seconds, const std::function<void(double)>& start,
                                     const Observer& observe) {
    const auto begin = std::chrono::steady_clock::now();
    const auto left = [&] {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        return seconds - spent.count();
    };
    std::optional<TimedSolution> best;
    double best_accuracy = 0.0;
    double expected = 0.0;  // of the next solve [s]
    for (std::size_t k = 0; k < accuracies.size() && (k == 0 || expected < left()); ++k) {
        SolveSettings settings;
        settings.memory_limit = base.memory_limit;
        settings.seed = mix(base.seed, 0x74727574);
        settings.accuracy = accuracies[k];
        start(accuracies[k]);
        TimedSolution timed =
            solve_timed(scene, settings, k == 0 ? first_seconds : left(), observe);
        if (timed.solution.status == Status::cancelled || timed.is_out_of_time) break;
        if (k + 1 < accuracies.size())
            expected = timed.seconds * std::pow(accuracies[k] / accuracies[k + 1], growth);
        if (!timed.is_finite) continue;
        if (best && !is_surer(timed.solution, best->solution)) continue;
        best = std::move(timed);
        best_accuracy = accuracies[k];
        if (known_radiosity(scene, best->solution)) break;
    }
    if (!best) return std::nullopt;
    const double spent = best->seconds;
    return FoundTruth{ChartTruth(scene, std::move(best->solution)), best_accuracy, spent};
}

}  // namespace patchlight::server
