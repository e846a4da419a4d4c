#include "server/selftest/answer_sheet.h"

#include "server/selftest/known_way.h"
#include "solver/solve_scene.h"

#include <cmath>
#include <utility>

namespace patchlight::server {
namespace {

constexpr double beyond_share = 0.05;  // of estimates that may be below the true error
constexpr double false_alarm = 1e-3;

/// The least k that more than k of n are beyond by chance with less than `false_alarm`.
int most_beyond(int n) {
    double exactly = std::pow(1.0 - beyond_share, n), more = 1.0 - exactly;
    int k = 0;
    while (more >= false_alarm) {
        exactly *= beyond_share / (1.0 - beyond_share) * (n - k) / (k + 1);
        more -= exactly;
        ++k;
    }
    return k;
}

}  // namespace

AnswerSheet::AnswerSheet(Take take, Observer observe)
    : take_(std::move(take)), observe_(std::move(observe)) {}

Solution AnswerSheet::solve(const Scene& scene, const SolveSettings& settings) const {
    Solution solution = solve_scene(scene, settings, observe_);
    if (solution.status == Status::cancelled) throw SelftestInterrupted();
    return solution;
}

AnswerSheet::Factors AnswerSheet::view_factors(const Scene& scene,
                                               const SolveSettings& settings) const {
    const ViewFactorSolver solver(scene, settings, Grouping::object);
    Factors factors;
    factors.patches_of_first = solver.groups().patches.front().size();
    factors.report =
        solver.find([&](const GroupFactors& row) { factors.rows.push_back(row); }, observe_);
    if (factors.report.status == Status::cancelled) throw SelftestInterrupted();
    return factors;
}

void AnswerSheet::add(KnownAnswer answer) {
    const Clock::time_point now = Clock::now();
    answer.seconds = std::chrono::duration<double>(now - last_).count();
    take_(answer);
    last_ = Clock::now();
}

void AnswerSheet::add_field_error(const std::string& name, const std::string& quantity,
                                  const Solution& solution, double true_error) {
    const double estimate = solution.error.estimate.value_or(0.0);
    ++fields_;
    if (!(true_error <= estimate)) ++beyond_estimate_;
    add({name, quantity, method_text(solution.settings), true_error, 0.0,
         solution.error.met() ? *solution.error.target : estimate});
}

void AnswerSheet::finish() {
    if (fields_ == 0) return;
    add({"estimates of " + std::to_string(fields_) + " fields", "true errors above theirs",
         "accuracy", static_cast<double>(beyond_estimate_), 0.0,
         static_cast<double>(most_beyond(fields_))});
}

}  // namespace patchlight::server
