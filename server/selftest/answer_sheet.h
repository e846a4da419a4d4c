#pragma once

#include "server/selftest/known_answer.h"
#include "solver/settings.h"
#include "solver/solution.h"
#include "solver/view_factors.h"

#include <chrono>
#include <functional>

namespace patchlight::server {

/// Work was stopped from outside.
struct SelftestInterrupted {};

/// What a family of cases solves with and hands its answers to.
class AnswerSheet {
  public:
    using Take = std::function<void(const KnownAnswer&)>;

    /// `take` is called with each answer as it comes.
    AnswerSheet(Take take, Observer observe);

    /// Throws SelftestInterrupted if the observer stopped the work.
    Solution solve(const Scene& scene, const SolveSettings& settings) const;

    /// View factors between the objects of a scene: one row of factors and standard errors for
    /// each object. Throws likewise.
    struct Factors {
        std::vector<GroupFactors> rows;
        ViewFactorReport report;
        std::size_t patches_of_first = 0;  // object
    };
    Factors view_factors(const Scene& scene, const SolveSettings& settings) const;

    /// Hands an answer on, with the time since the one before.
    void add(KnownAnswer answer);

    /// True error of the displayed field of a solve to an accuracy, on the scale of that accuracy
    /// [1]. Its bound is the accuracy that was asked for, if the solve says that it was met, else
    /// the estimate.
    void add_field_error(const std::string& name, const std::string& quantity,
                         const Solution& solution, double true_error);

    /// Last, if there were true errors: how many of them were above their estimates, which may
    /// happen in 1 of 20 cases each. Bound: what more are by chance in less than 1 of 1000 runs.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    Take take_;
    Observer observe_;
    Clock::time_point last_ = Clock::now();
    int fields_ = 0, beyond_estimate_ = 0;
};

}  // namespace patchlight::server
