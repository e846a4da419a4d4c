#pragma once

#include "solver/accuracy/gathered_light.h"
#include "solver/accuracy/judge.h"
#include "solver/accuracy/transport_check.h"

#include <cmath>
#include <functional>

namespace patchlight {

/// How wrong a round of gathering is: everything that is measured, and what the judge makes of it.
struct MeasuredRound {
    CheckReport checks;
    Evidence evidence;  // `checks` are those of this round, wherever it is
    ErrorReport error;
    double beyond_residual = 0.0;  // what goes round beyond what check points say, over the norm
    /// What the residual comes to once it has gone round, over itself; 1 where that is counted [1].
    double amplified() const {
        const double missed = passed_on * checks.at_most(1.0) / evidence.light.norm;
        return missed > 0.0 ? std::hypot(1.0, beyond_residual / missed) : 1.0;
    }
    std::vector<FluxRegion> regions;  // that particles were compared in; empty: none were sent
};

/// Measures rounds of gathering to a target.
struct ErrorMeasure {
    const Scene& scene;
    const PatchMesh& mesh;
    const GatheredLight& light;
    const std::vector<double>&backs, &escaped;  // shares of each patch's light [1]
    const RayScene& rays;
    double target = 0.0;  // [1]

    /// Until it is known well enough: where the target would be met but for the doubt that few
    /// points leave, or one of them counts for very much, more of them.
    /// In a hurry there are few at a time, and as many as `go_on` allows.
    MeasuredRound at(const GatherAim& aim, std::uint64_t seed, bool is_hurried,
                     const std::function<bool()>& go_on) const;

    /// Adds what particles say; as many as about `seconds` allow.
    void check_from_lamps(const GatherAim& aim, std::uint64_t seed, double seconds,
                          MeasuredRound& round) const;

  private:
    void judge_round(const ReflectedLight& reflected, MeasuredRound& round) const;
    void carry_residual(std::uint64_t seed, MeasuredRound& round) const;
    std::optional<double> propagated(const CheckReport& checks, double norm) const;
};

}  // namespace patchlight
