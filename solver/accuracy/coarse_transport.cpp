#include "solver/accuracy/coarse_transport.h"

#include "solver/transport/gather.h"
#include "solver/transport/gauss_seidel.h"
#include "solver/transport/shooting.h"

#include <utility>

namespace patchlight {

namespace {
constexpr int most_sweeps = 1000;
constexpr int most_shots = 10'000'000;
}  // namespace

MatrixTransport::MatrixTransport(const ExchangeMatrix& exchange, std::vector<double> area,
                                 Field reflectance, bool is_exact, std::span<const double> within)
    : factors_(exchange, within),
      area_(std::move(area)),
      reflectance_(std::move(reflectance)),
      is_exact_(is_exact) {}

Transported MatrixTransport::solve(const Field& exitance, double tolerance,
                                   const Observe& observe) const {
    const RadiosityProblem problem{factors_, area_, exitance, reflectance_};
    SolveReport report = solve_gauss_seidel(problem, {tolerance, most_sweeps, observe});
    return {std::move(report.radiosity), std::move(report.residual.irradiance),
            report.residual.algebraic_bound, std::move(report.convergence), report.stopped_by};
}

std::optional<Field> MatrixTransport::once(const Field& radiosity) const {
    return gather_all(factors_, radiosity);
}

ShotTransport::ShotTransport(const FormFactorEngine& engine, std::vector<double> area,
                             Field reflectance)
    : rows_(engine, area.size(), kept_row_bytes),
      area_(std::move(area)),
      reflectance_(std::move(reflectance)) {}

Transported ShotTransport::solve(const Field& exitance, double tolerance,
                                 const Observe& observe) const {
    const ShootingProblem problem{rows_, area_, exitance, reflectance_};
    const ShootingStop stop{tolerance, most_shots, [&](const ShotSoFar& state) {
                                return observe ? observe(state.shots, state.residual)
                                               : StopReason::tolerance;
                            }};
    ShootingReport report = shoot(problem, stop);
    return {std::move(report.state.radiosity), std::move(report.state.irradiance),
            report.state.algebraic_bound, std::move(report.convergence), report.stopped_by};
}

}  // namespace patchlight
