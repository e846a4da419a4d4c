#include "tests/solver/transport/row_engines.h"

#include "tests/solver/scenes.h"

#include <Eigen/Dense>

#include <numeric>

namespace patchlight {

MatrixEngine::MatrixEngine(std::vector<std::vector<double>> factors)
    : factors_(std::move(factors)) {}

void MatrixEngine::row(PatchIndex i, FactorRow& row) const {
    ++asked_;
    row.clear();
    for (PatchIndex j = 0; j < factors_.size(); ++j)
        if (factors_[i][j] > 0.0) row.add(j, factors_[i][j], 0.0, 1.0);
    row.outside = outside(i);
    row.rays = 10;
}

Outside MatrixEngine::outside(PatchIndex i) const {
    return {0.0, 1.0 - std::accumulate(factors_[i].begin(), factors_[i].end(), 0.0), 0};
}

std::vector<std::vector<double>> random_rows(std::size_t n, double least, unsigned seed) {
    std::mt19937 chance(seed);
    std::vector<std::vector<double>> rows(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < n; ++j)
            if (i != j && uniform(chance) < 0.7) sum += rows[i][j] = uniform(chance);
        const double wanted = least + (1.0 - least) * uniform(chance);
        for (double& factor : rows[i]) factor *= sum > 0.0 ? wanted / sum : 0.0;
    }
    return rows;
}

std::vector<std::vector<double>> alike(std::size_t n) {
    std::vector<std::vector<double>> rows(n,
                                          std::vector<double>(n, 1.0 / static_cast<double>(n - 1)));
    for (std::size_t i = 0; i < n; ++i) rows[i][i] = 0.0;
    return rows;
}

OwnedShooting::OwnedShooting(std::vector<std::vector<double>> factors, std::size_t channels,
                             std::size_t bytes)
    : engine(std::move(factors)),
      rows(engine, engine.factors().size(), bytes),
      problem{rows, std::vector<double>(engine.factors().size(), 1.0), {}, {}} {
    problem.exitance.assign(channels, std::vector<double>(problem.size(), 0.0));
    problem.reflectance.assign(channels, std::vector<double>(problem.size(), 0.5));
}

std::unique_ptr<OwnedShooting> random_shooting(std::vector<std::vector<double>> factors,
                                               std::size_t channels, double most, unsigned seed,
                                               std::size_t bytes) {
    auto owned = std::make_unique<OwnedShooting>(std::move(factors), channels, bytes);
    std::mt19937 chance(seed);
    ShootingProblem& problem = owned->problem;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        problem.area[i] = 0.2 + uniform(chance);
        for (std::size_t c = 0; c < channels; ++c) {
            problem.reflectance[c][i] = most * uniform(chance);
            if (i % 5 == 0) problem.exitance[c][i] = uniform(chance);
        }
    }
    return owned;
}

Field shot_directly(const OwnedShooting& owned) {
    const ShootingProblem& problem = owned.problem;
    const auto n = static_cast<Eigen::Index>(problem.size());
    Field solution;
    for (std::size_t c = 0; c < problem.channels(); ++c) {
        Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
        for (PatchIndex i = 0; i < problem.size(); ++i)
            for (PatchIndex j = 0; j < problem.size(); ++j)
                system(i, j) -=
                    problem.reflectance[c][i] * problem.area[j] / problem.area[i] *
                    static_cast<double>(static_cast<float>(owned.engine.factors()[j][i]));
        const Eigen::VectorXd radiosity =
            system.partialPivLu().solve(Eigen::VectorXd::Map(problem.exitance[c].data(), n));
        solution.emplace_back(radiosity.begin(), radiosity.end());
    }
    return solution;
}

}  // namespace patchlight
