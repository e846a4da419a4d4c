#include "tests/solver/form_factors/matrices.h"

#include "tests/solver/form_factors/engine_scene.h"

#include <cmath>

namespace patchlight {

ExchangeMatrix empty_matrix(const std::vector<double>& areas) {
    ExchangeMatrix matrix;
    matrix.area = areas;
    matrix.start.push_back(0);
    matrix.backs.assign(areas.size(), 0.0);
    matrix.escaped = matrix.backs_variance = matrix.escaped_variance = matrix.backs;
    return matrix;
}

void add_entry(ExchangeMatrix& matrix, PatchIndex i, PatchIndex j, double exchange, double variance,
               double ceiling) {
    while (matrix.start.size() <= i) matrix.start.push_back(matrix.column.size());
    matrix.column.push_back(j);
    matrix.exchange.push_back(static_cast<float>(exchange));
    matrix.variance.push_back(static_cast<float>(variance));
    matrix.ceiling.push_back(static_cast<float>(ceiling));
}

void finish(ExchangeMatrix& matrix) {
    matrix.start.resize(matrix.size() + 1, matrix.column.size());
}

ExchangeMatrix random_closed(std::size_t n, double filled, unsigned seed) {
    std::mt19937 chance(seed);
    std::vector<double> area(n), scale(n, 1.0);
    for (double& a : area) a = 0.5 + uniform(chance);
    std::vector<std::vector<double>> kernel(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            // Neighbours always see each other, so that rows can be filled.
            if (j - i <= 2 || uniform(chance) < filled)
                kernel[i][j] = kernel[j][i] = 0.2 + uniform(chance);
    for (int pass = 0; pass < 2000; ++pass)  // symmetric scaling (Sinkhorn & Knopp, 1967)
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < n; ++j) sum += kernel[i][j] * scale[j];
            scale[i] = std::sqrt(scale[i] * area[i] / sum);
        }
    ExchangeMatrix matrix = empty_matrix(area);
    for (PatchIndex i = 0; i < n; ++i)
        for (PatchIndex j = i + 1; j < n; ++j)
            if (kernel[i][j] > 0.0) add_entry(matrix, i, j, kernel[i][j] * scale[i] * scale[j]);
    finish(matrix);
    return matrix;
}

double row_sum(const ExchangeMatrix& matrix, PatchIndex i) {
    double sum = 0.0;
    for (PatchIndex j = 0; j < matrix.size(); ++j)
        if (j != i) sum += entry(matrix, i, j);
    return sum / matrix.area[i];
}

}  // namespace patchlight
