#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/transport/shooting.h"

#include <atomic>
#include <memory>

namespace patchlight {

/// An engine out of a dense matrix of form factors, A_i F_ij symmetric or not. What a row lacks to
/// 1 escapes.
class MatrixEngine final : public FormFactorEngine {
  public:
    explicit MatrixEngine(std::vector<std::vector<double>> factors);

    bool pairwise() const override { return false; }
    void row(PatchIndex i, FactorRow& row) const override;
    Outside outside(PatchIndex i) const override;

    const std::vector<std::vector<double>>& factors() const { return factors_; }
    int asked() const { return asked_; }  // rows so far

  private:
    std::vector<std::vector<double>> factors_;
    mutable std::atomic<int> asked_ = 0;
};

/// Random rows that sum to between `least` and 1, not symmetric in any way.
std::vector<std::vector<double>> random_rows(std::size_t n, double least, unsigned seed);
/// Every patch sees every other alike.
std::vector<std::vector<double>> alike(std::size_t n);

/// A problem, and what it refers to.
struct OwnedShooting {
    OwnedShooting(std::vector<std::vector<double>> factors, std::size_t channels,
                  std::size_t bytes = 1 << 20);
    OwnedShooting(const OwnedShooting&) = delete;
    OwnedShooting& operator=(const OwnedShooting&) = delete;

    MatrixEngine engine;
    RowSource rows;
    ShootingProblem problem;  // areas 1, ρ = 0.5, E = 0 until set
};

/// Random areas, ρ up to `most`, light on some patches.
std::unique_ptr<OwnedShooting> random_shooting(std::vector<std::vector<double>> factors,
                                               std::size_t channels, double most, unsigned seed,
                                               std::size_t bytes = 1 << 20);

/// What shooting converges to: A_i B_i = A_i E_i + ρ_i Σ_j A_j F_ji B_j, by a dense factorisation.
Field shot_directly(const OwnedShooting& owned);

}  // namespace patchlight
