#pragma once

#include "solver/factor_groups.h"
#include "solver/mesh/make_patches.h"
#include "solver/settings.h"
#include "solver/solution.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// Factors from one group to those it sees, ascending: Σ A_i F_ij / Σ A_i over its patches i and
/// the other's j. `errors`: one standard error, absolute, that of the quadrature included.
struct GroupFactors {
    std::uint32_t from = 0;
    std::vector<std::uint32_t> to;
    std::vector<double> factors, errors;
};

struct ViewFactorReport {
    Status status = Status::converged;  // else there are no rows, or not all
    SolveSettings settings;             // with every choice made; no solver is among them
    std::size_t patches = 0;
    bool streamed = false;  // rows came one by one and were closed each on its own
    FormFactorReport form_factors;
    std::vector<Finding> findings;
    StageSeconds seconds;
};

/// View factors as a product of their own. As long as the pairs that see each other fit in memory
/// (2 GiB, or a quarter of the memory limit if that is less) they are repaired together, so that
/// rows obey closure and pairs reciprocity. Beyond, rows are computed one by one, each closed on
/// its own, and what rays measured is reciprocal to its error only.
class ViewFactorSolver {
  public:
    /// Cuts the patches. Throws as solve_scene does. The scene must outlive it.
    ViewFactorSolver(const Scene& scene, const SolveSettings& settings, Grouping grouping);

    const FactorGroups& groups() const { return groups_; }

    /// Hands one group's factors after another to `take`, from the calling thread.
    ViewFactorReport find(const std::function<void(const GroupFactors&)>& take,
                          const Observer& observe) const;

  private:
    const Scene& scene_;
    SolveSettings settings_;  // planned
    MeshLines lines_;
    PatchMesh mesh_;
    FactorGroups groups_;
    double mesh_seconds_ = 0.0;
};

}  // namespace patchlight
