#pragma once

#include "solver/form_factors/exchange_matrix.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// The matrix F_ij that the solvers multiply with: each row dense or sparse, whichever is smaller.
class FormFactorMatrix {
  public:
    /// `within`: F_ii of what is not flat; or empty.
    explicit FormFactorMatrix(const ExchangeMatrix& exchange, std::span<const double> within = {});

    std::size_t size() const { return rows_.size(); }
    bool is_dense(PatchIndex i) const { return rows_[i].dense; }
    /// All N factors of a dense row.
    std::span<const float> dense(PatchIndex i) const {
        return {factors_.data() + rows_[i].start, size()};
    }
    /// Columns, ascending, and factors of a sparse row.
    std::span<const PatchIndex> columns(PatchIndex i) const {
        return {columns_.data() + rows_[i].first_column, rows_[i].count};
    }
    std::span<const float> factors(PatchIndex i) const {
        return {factors_.data() + rows_[i].start, rows_[i].count};
    }

    double row_sum(PatchIndex i) const { return rows_[i].sum; }
    double at(PatchIndex i, PatchIndex j) const;

  private:
    struct Row {
        std::size_t start = 0;         // in factors_
        std::size_t first_column = 0;  // in columns_, of a sparse row
        std::size_t count = 0;         // entries
        double sum = 0.0;
        bool dense = false;
    };
    std::vector<Row> rows_;
    std::vector<float> factors_;
    std::vector<PatchIndex> columns_;
};

}  // namespace patchlight
