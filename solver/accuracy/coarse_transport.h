#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/form_factors/form_factor_matrix.h"
#include "solver/transport/row_source.h"
#include "solver/transport/stop_rule.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace patchlight {

/// What comes of light that is given off on patches.
struct Transported {
    Field radiosity;   // B = E + ρ F B [W/m²]
    Field irradiance;  // F B [W/m²]
    std::optional<double> algebraic_bound;
    std::vector<ConvergenceStep> convergence;
    StopReason stopped_by = StopReason::tolerance;
};

/// Light between patches, for whatever is given off: by a stored matrix, or by shooting on rows
/// that are computed on demand.
class CoarseTransport {
  public:
    using Observe = std::function<StopReason(int iteration, double residual)>;
    virtual ~CoarseTransport() = default;
    /// Whether there is a matrix: then `exitance` may be negative, and solving takes little time.
    virtual bool has_matrix() const = 0;
    /// Whether light between patches that nothing can come between is exact.
    virtual bool is_exact() const = 0;
    /// `exitance` for each channel in use.
    virtual Transported solve(const Field& exitance, double tolerance,
                              const Observe& observe) const = 0;
    /// F B alone, if there is a matrix.
    virtual std::optional<Field> once(const Field& radiosity) const = 0;
};

class MatrixTransport final : public CoarseTransport {
  public:
    MatrixTransport(const ExchangeMatrix& exchange, std::vector<double> area, Field reflectance,
                    bool is_exact, std::span<const double> within = {});
    Transported solve(const Field& exitance, double tolerance,
                      const Observe& observe) const override;
    bool has_matrix() const override { return true; }
    bool is_exact() const override { return is_exact_; }
    std::optional<Field> once(const Field& radiosity) const override;

  private:
    FormFactorMatrix factors_;
    std::vector<double> area_;  // [m²]
    Field reflectance_;         // [1]
    bool is_exact_;
};

class ShotTransport final : public CoarseTransport {
  public:
    ShotTransport(const FormFactorEngine& engine, std::vector<double> area, Field reflectance);
    Transported solve(const Field& exitance, double tolerance,
                      const Observe& observe) const override;
    bool has_matrix() const override { return false; }
    bool is_exact() const override { return false; }
    std::optional<Field> once(const Field&) const override { return std::nullopt; }
    const RowSource& rows() const { return rows_; }

  private:
    mutable RowSource rows_;  // keeps rows for the next solve
    std::vector<double> area_;
    Field reflectance_;
};

}  // namespace patchlight
