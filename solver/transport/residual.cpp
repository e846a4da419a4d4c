#include "solver/transport/residual.h"

#include "solver/transport/gather.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

double norm(const RadiosityProblem& problem, const std::vector<double>& x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += problem.area[i] * x[i] * x[i];
    return std::sqrt(sum);
}

double contraction_of(const RadiosityProblem& problem, std::size_t c) {
    double most_seen = 0.0;
    for (PatchIndex i = 0; i < problem.size(); ++i)
        most_seen = std::max(most_seen, problem.factors.row_sum(i));
    return *std::max_element(problem.reflectance[c].begin(), problem.reflectance[c].end()) *
           most_seen;
}

}  // namespace

double luminance_weight(std::size_t channel, std::size_t channels) {
    if (channels == 1) return 1.0;
    constexpr std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
    return weights[channel];
}

double contraction(const RadiosityProblem& problem) {
    double q = 0.0;
    for (std::size_t c = 0; c < problem.channels(); ++c)
        q = std::max(q, contraction_of(problem, c));
    return q;
}

Residual measure_residual(const RadiosityProblem& problem, const Field& radiosity) {
    Residual result;
    result.irradiance = gather_all(problem.factors, radiosity);
    std::vector<double> reflected(problem.size(), 0.0);  // Y(B − E)
    double bound = 0.0;
    for (std::size_t c = 0; c < problem.channels(); ++c) {
        const double weight = luminance_weight(c, problem.channels());
        std::vector<double> r(problem.size());
        for (std::size_t i = 0; i < problem.size(); ++i) {
            r[i] = problem.exitance[c][i] + problem.reflectance[c][i] * result.irradiance[c][i] -
                   radiosity[c][i];
            reflected[i] += weight * (radiosity[c][i] - problem.exitance[c][i]);
        }
        const double size = norm(problem, r), given = norm(problem, problem.exitance[c]);
        if (given > 0.0) result.relative = std::max(result.relative, size / given);
        bound += weight * size / (1.0 - contraction_of(problem, c));
        result.residual.push_back(std::move(r));
    }
    const double scale = norm(problem, reflected) - bound;
    if (bound == 0.0)
        result.algebraic_bound = 0.0;
    else if (scale > 0.0 && bound > 0.0)
        result.algebraic_bound = bound / scale;
    return result;
}

}  // namespace patchlight
