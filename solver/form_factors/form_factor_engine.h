#pragma once

#include "solver/mesh/patch_mesh.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace patchlight {

/// Light of patch i that meets no front: row_sum + backs + escaped = 1.
struct Outside {
    double backs = 0.0;      // lands on backs of one-sided surfaces [1]
    double escaped = 0.0;    // leaves the scene [1]
    std::uint64_t rays = 0;  // that told the two shares; 0: not sampled
};

/// Row i of the form-factor matrix: its non-zero entries, ascending by column.
struct FactorRow {
    std::vector<PatchIndex> columns;
    std::vector<double>
        factors;  // F_ij, share of the light leaving i that arrives directly at j [1]
    std::vector<double> variance;    // of F_ij; 0: exact [1]
    std::vector<double> ceiling;     // F_ij with nothing between, or the most it can be [1]
    std::optional<Outside> outside;  // if it came with the row
    std::uint64_t rays = 0;          // cast for this row
    int samples = 1;  // how much the row counts beside the other end's: both equal, or their ratio

    void clear() {
        columns.clear();
        factors.clear();
        variance.clear();
        ceiling.clear();
        outside.reset();
        rays = 0;
        samples = 1;
    }
    void add(PatchIndex j, double factor, double factor_variance, double most) {
        columns.push_back(j);
        factors.push_back(factor);
        variance.push_back(factor_variance);
        ceiling.push_back(most);
    }
};

/// Time ran out within a row.
struct OutOfTime : std::runtime_error {
    OutOfTime() : std::runtime_error("out of time within a row of form factors") {}
};

/// Computes form factors between patches. Const and without hidden state: rows may be asked for in
/// any order and from several threads, and are the same bytes each time.
class FormFactorEngine {
  public:
    virtual ~FormFactorEngine() = default;

    /// Whether an entry is computed once for the unordered pair, so that A_i F_ij = A_j F_ji. Then
    /// row(i) holds only the columns j > i.
    virtual bool pairwise() const = 0;

    /// From now on rows are given up once `in_time`, asked from several threads, is false.
    void give_up_unless(std::function<bool()> in_time) { in_time_ = std::move(in_time); }

    /// Row i; a covered patch has an empty row. Throws OutOfTime if it is given up, else nothing.
    virtual void row(PatchIndex i, FactorRow& row) const = 0;

    /// Row i with all its columns, for who wants no matrix. Of a pairwise engine, entries that rays
    /// measured may differ a little from what the other end's row says.
    virtual void whole_row(PatchIndex i, FactorRow& whole) const { row(i, whole); }

    /// Where the light of patch i that meets no front goes; asked for where a row does not say.
    virtual Outside outside(PatchIndex i) const = 0;

  protected:
    /// To be called every tenth of a second or so. Throws OutOfTime.
    void look_at_clock() const {
        if (in_time_ && !in_time_()) throw OutOfTime();
    }

  private:
    std::function<bool()> in_time_;
};

}  // namespace patchlight
