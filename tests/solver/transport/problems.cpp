#include "tests/solver/transport/problems.h"

#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/scenes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace patchlight {

OwnedProblem::OwnedProblem(const ExchangeMatrix& exchange, std::size_t channels)
    : factors(exchange), problem{factors, exchange.area, {}, {}} {
    problem.exitance.assign(channels, std::vector<double>(exchange.size(), 0.0));
    problem.reflectance.assign(channels, std::vector<double>(exchange.size(), 0.5));
}

ExchangeMatrix uniform_exchange(std::size_t n) {
    ExchangeMatrix matrix = empty_matrix(std::vector<double>(n, 1.0));
    for (PatchIndex i = 0; i < n; ++i)
        for (PatchIndex j = i + 1; j < n; ++j)
            add_entry(matrix, i, j, 1.0 / static_cast<double>(n - 1));
    finish(matrix);
    return matrix;
}

std::unique_ptr<OwnedProblem> random_problem(std::size_t n, double filled, std::size_t channels,
                                             double most, unsigned seed) {
    auto owned = std::make_unique<OwnedProblem>(random_closed(n, filled, seed), channels);
    std::mt19937 chance(seed);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < n; ++i) {
            owned->problem.reflectance[c][i] = most * uniform(chance);
            if (i % 5 == 0) owned->problem.exitance[c][i] = uniform(chance);
        }
    for (std::size_t c = 0; c < channels; ++c) owned->problem.reflectance[c][1] = most;
    return owned;
}

Field solve_directly(const RadiosityProblem& problem) {
    const auto n = static_cast<Eigen::Index>(problem.size());
    Field solution;
    for (std::size_t c = 0; c < problem.channels(); ++c) {
        Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
        for (PatchIndex i = 0; i < problem.size(); ++i)
            for (PatchIndex j = 0; j < problem.size(); ++j)
                system(i, j) -= problem.reflectance[c][i] * problem.factors.at(i, j);
        const Eigen::VectorXd radiosity =
            system.partialPivLu().solve(Eigen::VectorXd::Map(problem.exitance[c].data(), n));
        solution.emplace_back(radiosity.begin(), radiosity.end());
    }
    return solution;
}

double relative_error(const RadiosityProblem& problem, const Field& radiosity, const Field& exact) {
    double error = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        double off = 0.0, reflected = 0.0;
        for (std::size_t c = 0; c < problem.channels(); ++c) {
            const double weight = luminance_weight(c, problem.channels());
            off += weight * (radiosity[c][i] - exact[c][i]);
            reflected += weight * (exact[c][i] - problem.exitance[c][i]);
        }
        error += problem.area[i] * off * off;
        scale += problem.area[i] * reflected * reflected;
    }
    return std::sqrt(error / scale);
}

double largest_difference(const Field& a, const Field& b) {
    double difference = 0.0, scale = 0.0;
    for (std::size_t c = 0; c < b.size(); ++c)
        for (std::size_t i = 0; i < b[c].size(); ++i) {
            difference = std::max(difference, std::abs(a[c][i] - b[c][i]));
            scale = std::max(scale, std::abs(b[c][i]));
        }
    return difference / scale;
}

}  // namespace patchlight
