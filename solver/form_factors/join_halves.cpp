#include "solver/form_factors/join_halves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

/// Entries by column: the transposed pattern, each column's entries ascending by row.
struct Columns {
    std::vector<std::size_t> start;
    std::vector<PatchIndex> row;
    std::vector<std::size_t> entry;  // where the row keeps it

    explicit Columns(const ExchangeMatrix& matrix) : start(matrix.size() + 1, 0) {
        for (const PatchIndex j : matrix.column) ++start[j + 1];
        for (std::size_t j = 0; j < matrix.size(); ++j) start[j + 1] += start[j];
        row.resize(matrix.column.size());
        entry.resize(matrix.column.size());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (PatchIndex i = 0; i < matrix.size(); ++i)
            for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
                const std::size_t at = next[matrix.column[k]]++;
                row[at] = i;
                entry[at] = k;
            }
    }
};

/// Calls visit(j, here, there) for each j that row i or column i names, ascending; an absent half
/// is `none`.
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
template <typename Visit>
void for_each_pair(const ExchangeMatrix& matrix, const Columns& columns, PatchIndex i,
                   const Visit& visit) {
    std::size_t here = matrix.start[i], there = columns.start[i];
    const std::size_t here_end = matrix.start[i + 1], there_end = columns.start[i + 1];
    while (here < here_end || there < there_end) {
        const PatchIndex j_here =
            here < here_end ? matrix.column[here] : std::numeric_limits<PatchIndex>::max();
        const PatchIndex j_there =
            there < there_end ? columns.row[there] : std::numeric_limits<PatchIndex>::max();
        const PatchIndex j = std::min(j_here, j_there);
        visit(j, j_here == j ? here++ : none, j_there == j ? columns.entry[there++] : none);
    }
}

}  // namespace

ClosureReport measure_rows(const ExchangeMatrix& matrix,
                           const std::vector<std::optional<Outside>>& outside) {
    ClosureReport report;
    report.row_sum_min = std::numeric_limits<double>::infinity();
    const Columns columns(matrix);
    double total = 0.0;
    for (PatchIndex i = 0; i < matrix.size(); ++i) {
        double sum = 0.0;
        for_each_pair(matrix, columns, i, [&](PatchIndex j, std::size_t here, std::size_t there) {
            const double h = here == none ? 0.0 : static_cast<double>(matrix.exchange[here]);
            const double back = there == none ? 0.0 : static_cast<double>(matrix.exchange[there]);
            sum += h;
            report.reciprocity_max =
                std::max(report.reciprocity_max,
                         std::abs(h - back) / std::min(matrix.area[i], matrix.area[j]));
        });
        sum /= matrix.area[i];
        const Outside away = outside[i].value_or(Outside{});
        report.row_sum_min = std::min(report.row_sum_min, sum);
        report.row_sum_max = std::max(report.row_sum_max, sum);
        report.row_sum_mean += sum * matrix.area[i];
        report.closure_max =
            std::max(report.closure_max, std::abs(sum + away.backs + away.escaped - 1.0));
        total += matrix.area[i];
    }
    report.row_sum_mean /= total;
    return report;
}

void join_halves(ExchangeMatrix& matrix, const std::vector<int>& samples) {
    const Columns columns(matrix);
    ExchangeMatrix joined;
    joined.start.push_back(0);
    for (PatchIndex i = 0; i < matrix.size(); ++i) {
        for_each_pair(matrix, columns, i, [&](PatchIndex j, std::size_t here, std::size_t there) {
            if (j <= i) return;
            const double mine = samples[i] / matrix.area[i], other = samples[j] / matrix.area[j];
            const auto pooled = [&](const std::vector<float>& quantity, double w, double v) {
                const double a = here == none ? 0.0 : w * static_cast<double>(quantity[here]);
                const double b = there == none ? 0.0 : v * static_cast<double>(quantity[there]);
                return a + b;
            };
            const double w = mine / (mine + other), v = other / (mine + other);
            joined.column.push_back(j);
            joined.exchange.push_back(static_cast<float>(pooled(matrix.exchange, w, v)));
            joined.variance.push_back(static_cast<float>(pooled(matrix.variance, w * w, v * v)));
            joined.ceiling.push_back(static_cast<float>(std::min(matrix.area[i], matrix.area[j])));
        });
        joined.start.push_back(joined.column.size());
    }
    matrix.start = std::move(joined.start);
    matrix.column = std::move(joined.column);
    matrix.exchange = std::move(joined.exchange);
    matrix.variance = std::move(joined.variance);
    matrix.ceiling = std::move(joined.ceiling);
}

}  // namespace patchlight
