#include "solver/form_factors/exchange_matrix.h"

#include "solver/form_factors/join_halves.h"
#include "solver/form_factors/outside_shares.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

constexpr std::size_t most_rows = 64;  // computed between two words to the observer
constexpr double most_rays = 2e6;      // cast between them, about a tenth of a second [1]
constexpr double sums_to_one =
    1e-6;  // a row of exact entries that sums to 1 this well sees nothing else [1]

void append(ExchangeMatrix& matrix, PatchIndex i, const FactorRow& row) {
    const double area = matrix.area[i];
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
        matrix.column.push_back(row.columns[k]);
        matrix.exchange.push_back(static_cast<float>(area * row.factors[k]));
        matrix.variance.push_back(static_cast<float>(area * area * row.variance[k]));
        matrix.ceiling.push_back(static_cast<float>(area * row.ceiling[k]));
    }
    matrix.start.push_back(matrix.column.size());
    matrix.rays += row.rays;
}

std::vector<double> row_sums(const ExchangeMatrix& matrix) {
    std::vector<double> sums(matrix.size(), 0.0);
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            sums[i] += static_cast<double>(matrix.exchange[k]);
            sums[matrix.column[k]] += static_cast<double>(matrix.exchange[k]);
        }
    for (PatchIndex i = 0; i < matrix.size(); ++i) sums[i] /= matrix.area[i];
    return sums;
}

/// Rows that have an entry which is not exact.
std::vector<bool> uncertain_rows(const ExchangeMatrix& matrix) {
    std::vector<bool> uncertain(matrix.size(), false);
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
            if (matrix.variance[k] > 0.0f) uncertain[i] = uncertain[matrix.column[k]] = true;
    return uncertain;
}

/// False if the engine gave up, of which the observer is told so that it says why.
bool in_time(const FractionObserver& observe, const std::function<void()>& work) {
    try {
        work();
        return true;
    } catch (const OutOfTime&) {
        observe(1.0);
        return false;
    }
}

bool build_rows(const FormFactorEngine& engine, ExchangeMatrix& matrix,
                std::vector<std::optional<Outside>>& outside, std::vector<int>& samples,
                const FractionObserver& observe) {
    const std::size_t n = matrix.size();
    std::vector<FactorRow> rows(most_rows);
    std::size_t count = 1;
    for (std::size_t first = 0; first < n; first += count) {
        const double rays_a_row =
            static_cast<double>(matrix.rays) / static_cast<double>(std::max<std::size_t>(first, 1));
        count = rays_a_row * most_rows > most_rays
                    ? static_cast<std::size_t>(most_rays / rays_a_row)
                : first == 0 ? 1
                             : most_rows;
        count = std::min(std::max<std::size_t>(count, 2), n - first);
        matrix.complete = in_time(observe, [&] {
            tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
                engine.row(static_cast<PatchIndex>(first + k), rows[k]);
            });
        });
        if (!matrix.complete) return false;
        for (std::size_t k = 0; k < count; ++k) {
            append(matrix, static_cast<PatchIndex>(first + k), rows[k]);
            outside[first + k] = rows[k].outside;
            samples[first + k] = rows[k].samples;
        }
        const double done = static_cast<double>(first + count) / static_cast<double>(n);
        if (!observe(engine.pairwise() ? 1.0 - (1.0 - done) * (1.0 - done) : done)) {
            matrix.complete = false;
            return false;
        }
    }
    return true;
}

}  // namespace

ExchangeMatrix build_exchange(const FormFactorEngine& engine, const Scene& scene,
                              const PatchMesh& mesh, const FractionObserver& observe) {
    ExchangeMatrix matrix;
    double total = 0.0;
    for (const Patch& patch : mesh.patches) total += patch.area;
    matrix.unit = total / static_cast<double>(mesh.size());
    for (const Patch& patch : mesh.patches) matrix.area.push_back(patch.area / matrix.unit);
    matrix.start.push_back(0);
    std::vector<std::optional<Outside>> known(mesh.size());
    std::vector<int> samples(mesh.size(), 1);
    if (!build_rows(engine, matrix, known, samples, observe)) return matrix;
    if (!engine.pairwise()) {
        matrix.measured = measure_rows(matrix, known);
        join_halves(matrix, samples);
    }
    std::vector<Outside> outside(mesh.size());
    const std::vector<double> sums = row_sums(matrix);
    const std::vector<bool> uncertain = uncertain_rows(matrix);
    matrix.complete = in_time(observe, [&] {
        tbb::parallel_for(std::size_t{0}, mesh.size(), [&](std::size_t i) {
            if (known[i])
                outside[i] = *known[i];
            else if (uncertain[i] ||
                     std::abs(1.0 - sums[i]) > sums_to_one)  // else: no ray where nothing blocks
                outside[i] = engine.outside(static_cast<PatchIndex>(i));
        });
    });
    if (!matrix.complete) return matrix;
    set_outside(matrix, outside, make_clusters(scene, mesh, find_plane_groups(scene)), sums);
    for (std::size_t i = 0; i < mesh.size(); ++i)
        if (!known[i]) matrix.rays += outside[i].rays;
    if (engine.pairwise()) matrix.measured = measure_closure(matrix);
    return matrix;
}

ClosureReport measure_closure(const ExchangeMatrix& matrix) {
    ClosureReport report;
    report.row_sum_min = std::numeric_limits<double>::infinity();
    const std::vector<double> sums = row_sums(matrix);
    double total = 0.0;
    for (PatchIndex i = 0; i < matrix.size(); ++i) {
        report.row_sum_min = std::min(report.row_sum_min, sums[i]);
        report.row_sum_max = std::max(report.row_sum_max, sums[i]);
        report.row_sum_mean += sums[i] * matrix.area[i];
        report.closure_max = std::max(
            report.closure_max, std::abs(sums[i] + matrix.backs[i] + matrix.escaped[i] - 1.0));
        total += matrix.area[i];
    }
    report.row_sum_mean /= total;
    return report;
}

}  // namespace patchlight
