#include "solver/transport/shooting.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace patchlight {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_together = 8;     // shooters whose rows are computed at a time
constexpr double least_of_brightest = 0.25;  // of the brightest's unshot light, to be among them
constexpr int all_recorded = 32;             // first shots, each of which is recorded
constexpr double recorded_change = 0.95;     // then whenever so much of the unshot light is left

class Shooter {
  public:
    explicit Shooter(const ShootingProblem& problem) : problem_(problem) {
        state_.radiosity = state_.unshot = problem.exitance;
        state_.irradiance = problem.exitance;
        for (auto& channel : state_.irradiance) std::fill(channel.begin(), channel.end(), 0.0);
        state_.lost.assign(problem.channels(), {0.0, 0.0});
        measure();
    }

    const ShotSoFar& state() const { return state_; }
    ShotSoFar& state() { return state_; }

    /// The patches to shoot next, brightest first; none if no light is left.
    std::vector<PatchIndex> brightest(std::size_t most) const {
        std::vector<std::pair<double, PatchIndex>> best;
        for (PatchIndex i = 0; i < problem_.size(); ++i) {
            const double light = power(i);
            if (!(light > 0.0)) continue;
            const std::pair<double, PatchIndex> entry{-light, i};
            if (best.size() == most && !(entry < best.back())) continue;
            best.insert(std::upper_bound(best.begin(), best.end(), entry), entry);
            if (best.size() > most) best.pop_back();
        }
        std::vector<PatchIndex> chosen;
        for (const auto& [negative, i] : best)
            if (negative <= least_of_brightest * best.front().first) chosen.push_back(i);
        return chosen;
    }

    void shoot(PatchIndex i, const ClosedRow& row) {
        for (std::size_t c = 0; c < problem_.channels(); ++c) {
            const double sent = state_.unshot[c][i] * problem_.area[i];
            state_.unshot[c][i] = 0.0;
            if (!(sent > 0.0)) continue;
            const std::vector<double>& reflectance = problem_.reflectance[c];
            for (std::size_t k = 0; k < row.columns.size(); ++k) {
                const PatchIndex j = row.columns[k];
                const double arriving =
                    sent * static_cast<double>(row.factors[k]) / problem_.area[j];
                const double reflected = reflectance[j] * arriving;
                state_.irradiance[c][j] += arriving;
                state_.radiosity[c][j] += reflected;
                state_.unshot[c][j] += reflected;
            }
            state_.lost[c][0] += sent * row.outside.backs;
            state_.lost[c][1] += sent * row.outside.escaped;
        }
        ++state_.shots;
        state_.algebraic_bound.reset();
    }

    void measure() {
        double unshot = 0.0, emitted = 0.0, bound = 0.0, reflected = 0.0;
        state_.residual = 0.0;
        for (std::size_t c = 0; c < problem_.channels(); ++c) {
            double left = 0.0, left_squared = 0.0, given = 0.0, given_squared = 0.0, whitest = 0.0;
            for (PatchIndex i = 0; i < problem_.size(); ++i) {
                const double a = problem_.area[i], u = state_.unshot[c][i],
                             e = problem_.exitance[c][i];
                left += a * u;
                left_squared += a * u * u;
                given += a * e;
                given_squared += a * e * e;
                whitest = std::max(whitest, problem_.reflectance[c][i]);
                reflected +=
                    luminance_weight(c, problem_.channels()) * a * (state_.radiosity[c][i] - e);
            }
            const double w = luminance_weight(c, problem_.channels());
            unshot += w * left;
            emitted += w * given;
            // ΔB itself is in B already; what it will bring is ρ/(1 − ρ) of it at most.
            bound += w * left * whitest / (1.0 - whitest);
            if (given_squared > 0.0)
                state_.residual =
                    std::max(state_.residual, std::sqrt(left_squared / given_squared));
        }
        state_.unshot_share = emitted > 0.0 ? unshot / emitted : 0.0;
        state_.algebraic_bound.reset();
        if (reflected > bound)
            state_.algebraic_bound = bound / (reflected - bound);
        else if (unshot == 0.0)
            state_.algebraic_bound = 0.0;
    }

  private:
    double power(PatchIndex i) const {
        double light = 0.0;
        for (std::size_t c = 0; c < problem_.channels(); ++c)
            light += luminance_weight(c, problem_.channels()) * state_.unshot[c][i];
        return light * problem_.area[i];
    }

    const ShootingProblem& problem_;
    ShotSoFar state_;
};

}  // namespace

ShootingReport shoot(const ShootingProblem& problem, const ShootingStop& stop) {
    const auto start = Clock::now();
    ShootingReport report;
    Shooter shooter(problem);
    double recorded = 2.0;  // unshot share at the last record
    const auto record = [&] {
        const ShotSoFar& s = shooter.state();
        if (s.shots > all_recorded && s.unshot_share > recorded_change * recorded) return;
        recorded = s.unshot_share;
        report.convergence.push_back({s.shots,
                                      std::chrono::duration<double>(Clock::now() - start).count(),
                                      s.residual, s.unshot_share});
    };
    while (true) {
        const ShotSoFar& s = shooter.state();
        if (s.algebraic_bound && *s.algebraic_bound <= stop.tolerance) {
            report.stopped_by = StopReason::tolerance;
            break;
        }
        if (s.shots >= stop.max_shots) break;
        const std::size_t room = static_cast<std::size_t>(stop.max_shots - s.shots);
        const std::vector<PatchIndex> next = shooter.brightest(std::min(most_together, room));
        std::vector<const ClosedRow*> rows;
        try {
            rows = problem.rows.fetch(next);
        } catch (const OutOfTime&) {
            report.stopped_by = StopReason::time_limit;
            if (stop.observe && stop.observe(s) == StopReason::cancelled)
                report.stopped_by = StopReason::cancelled;
            shooter.measure();
            break;
        }
        report.stopped_by = StopReason::tolerance;
        for (std::size_t k = 0; k < next.size(); ++k) {
            shooter.shoot(next[k], *rows[k]);
            const bool is_last = k + 1 == next.size();
            if (is_last) shooter.measure();
            if (is_last) record();
            if (stop.observe) report.stopped_by = stop.observe(s);
            if (report.stopped_by != StopReason::tolerance) break;
        }
        if (report.stopped_by != StopReason::tolerance) {
            shooter.measure();
            break;
        }
        report.stopped_by = StopReason::iteration_limit;
    }
    report.state = std::move(shooter.state());
    return report;
}

}  // namespace patchlight
