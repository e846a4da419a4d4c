#include "solver/form_factors/form_factor_matrix.h"

#include <algorithm>

namespace patchlight {

FormFactorMatrix::FormFactorMatrix(const ExchangeMatrix& exchange, std::span<const double> within)
    : rows_(exchange.size()) {
    const std::size_t n = exchange.size();
    const auto sees_itself = [&](PatchIndex i) { return !within.empty() && within[i] > 0.0; };
    for (PatchIndex i = 0; i < n; ++i) {
        rows_[i].count += sees_itself(i) ? 1 : 0;
        rows_[i].count += exchange.start[i + 1] - exchange.start[i];
        for (std::size_t k = exchange.start[i]; k < exchange.start[i + 1]; ++k)
            ++rows_[exchange.column[k]].count;
    }
    std::size_t factors = 0, columns = 0;
    for (Row& row : rows_) {
        row.dense = 2 * row.count >= n;  // a sparse entry takes twice the bytes
        row.start = factors;
        row.first_column = columns;
        factors += row.dense ? n : row.count;
        columns += row.dense ? 0 : row.count;
    }
    factors_.assign(factors, 0.0f);
    columns_.resize(columns);
    std::vector<std::size_t> filled(n, 0);
    const auto put = [&](PatchIndex i, PatchIndex j, double share) {
        Row& row = rows_[i];
        const auto factor = static_cast<float>(share);
        row.sum += static_cast<double>(factor);
        if (row.dense) {
            factors_[row.start + j] = factor;
            return;
        }
        factors_[row.start + filled[i]] = factor;
        columns_[row.first_column + filled[i]++] = j;
    };
    for (PatchIndex i = 0; i < n; ++i) {  // row j receives its columns i < j before its own turn
        if (sees_itself(i)) put(i, i, within[i]);
        for (std::size_t k = exchange.start[i]; k < exchange.start[i + 1]; ++k) {
            const double h = static_cast<double>(exchange.exchange[k]);
            const PatchIndex j = exchange.column[k];
            put(i, j, h / exchange.area[i]);
            put(j, i, h / exchange.area[j]);
        }
    }
}

double FormFactorMatrix::at(PatchIndex i, PatchIndex j) const {
    if (is_dense(i)) return static_cast<double>(dense(i)[j]);
    const auto row = columns(i);
    const auto place = std::lower_bound(row.begin(), row.end(), j);
    return place != row.end() && *place == j
               ? static_cast<double>(factors(i)[static_cast<std::size_t>(place - row.begin())])
               : 0.0;
}

}  // namespace patchlight
