#include "solver/factor_rows.h"

#include "solver/form_factors/close_row.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::size_t rows_at_a_time = 32;
constexpr std::size_t sampled_rows = 48;

}  // namespace

KeptRows::KeptRows(ExchangeMatrix&& exchange)
    : exchange_(std::move(exchange)), lower_start_(exchange_.size() + 1, 0) {
    std::vector<float>().swap(exchange_.ceiling);
    const std::size_t n = exchange_.size();
    for (const PatchIndex j : exchange_.column) ++lower_start_[j + 1];
    for (std::size_t j = 0; j < n; ++j) lower_start_[j + 1] += lower_start_[j];
    lower_row_.resize(exchange_.column.size());
    lower_entry_.resize(exchange_.column.size());
    std::vector<std::size_t> next(lower_start_.begin(), lower_start_.end() - 1);
    for (PatchIndex i = 0; i < n; ++i)
        for (std::size_t k = exchange_.start[i]; k < exchange_.start[i + 1]; ++k) {
            const std::size_t at = next[exchange_.column[k]]++;
            lower_row_[at] = i;
            lower_entry_[at] = k;
        }
}

bool KeptRows::visit(std::span<const PatchIndex> patches, const Visit& visit) {
    std::vector<PatchIndex> columns;
    std::vector<double> factors, variance;
    for (const PatchIndex i : patches) {
        columns.clear(), factors.clear(), variance.clear();
        const double area = exchange_.area[i];
        const auto add = [&](PatchIndex j, std::size_t k) {
            columns.push_back(j);
            factors.push_back(static_cast<double>(exchange_.exchange[k]) / area);
            variance.push_back(static_cast<double>(exchange_.variance[k]) / (area * area));
        };
        for (std::size_t l = lower_start_[i]; l < lower_start_[i + 1]; ++l)
            add(lower_row_[l], lower_entry_[l]);
        for (std::size_t k = exchange_.start[i]; k < exchange_.start[i + 1]; ++k)
            add(exchange_.column[k], k);
        if (!visit({i, columns, factors, variance})) return false;
    }
    return true;
}

bool StreamedRows::visit(std::span<const PatchIndex> patches, const Visit& visit) {
    std::vector<FactorRow> rows(rows_at_a_time);
    std::vector<Outside> outside(rows_at_a_time);
    std::vector<double> sums(rows_at_a_time);
    for (std::size_t first = 0; first < patches.size(); first += rows_at_a_time) {
        const std::size_t count = std::min(rows_at_a_time, patches.size() - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
            const PatchIndex i = patches[first + k];
            engine_.whole_row(i, rows[k]);
            sums[k] = std::accumulate(rows[k].factors.begin(), rows[k].factors.end(), 0.0);
            outside[k] = close_row(engine_, i, rows[k]);
        });
        for (std::size_t k = 0; k < count; ++k) {
            const PatchIndex i = patches[first + k];
            const FactorRow& row = rows[k];
            const double a = mesh_.patches[i].area;
            const Outside away = row.outside.value_or(outside[k]);
            rays_ += row.rays + (row.outside ? 0 : away.rays);
            open_ = open_ || away.escaped > 0.0;
            report_.row_sum_min = area_ > 0.0 ? std::min(report_.row_sum_min, sums[k]) : sums[k];
            report_.row_sum_max = std::max(report_.row_sum_max, sums[k]);
            report_.row_sum_mean += a * sums[k];
            report_.closure_max =
                std::max(report_.closure_max, std::abs(sums[k] + away.backs + away.escaped - 1.0));
            area_ += a;
            if (!visit({i, row.columns, row.factors, row.variance})) return false;
        }
    }
    return true;
}

ClosureReport StreamedRows::closure() const {
    ClosureReport report = report_;
    if (area_ > 0.0) report.row_sum_mean /= area_;
    return report;
}

double estimate_density(const FormFactorEngine& engine, const PatchMesh& mesh) {
    const std::size_t count = std::min(sampled_rows, mesh.size());
    std::vector<std::size_t> seen(count, 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        FactorRow row;
        engine.whole_row(static_cast<PatchIndex>((2 * k + 1) * mesh.size() / (2 * count)), row);
        seen[k] = row.columns.size();
    });
    const double total =
        static_cast<double>(std::accumulate(seen.begin(), seen.end(), std::size_t{0}));
    return total / (static_cast<double>(count) * static_cast<double>(mesh.size()));
}

}  // namespace patchlight
