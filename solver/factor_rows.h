#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/form_factors/form_factor_engine.h"
#include "solver/solution.h"

#include <functional>
#include <span>
#include <vector>

namespace patchlight {

/// One whole row of the matrix, ascending by column; good during the call.
struct FactorRowView {
    PatchIndex i = 0;
    std::span<const PatchIndex> columns;
    std::span<const double> factors;   // [1]
    std::span<const double> variance;  // [1]
};

/// Whole rows of the form-factor matrix, wherever they come from.
class FactorRows {
  public:
    /// Whether to go on.
    using Visit = std::function<bool(const FactorRowView&)>;
    virtual ~FactorRows() = default;
    /// Rows of `patches` in that order, from the calling thread; false if a visit ended it.
    virtual bool visit(std::span<const PatchIndex> patches, const Visit& visit) = 0;
};

/// Rows of a matrix that is there, both halves of each pair from its upper triangle.
class KeptRows final : public FactorRows {
  public:
    explicit KeptRows(ExchangeMatrix&& exchange);
    bool visit(std::span<const PatchIndex> patches, const Visit& visit) override;

  private:
    ExchangeMatrix exchange_;
    std::vector<std::size_t> lower_start_;  // per column: entries (row, place) below
    std::vector<PatchIndex> lower_row_;
    std::vector<std::size_t> lower_entry_;
};

/// Rows as an engine computes them, in parallel some at a time, each closed on its own.
class StreamedRows final : public FactorRows {
  public:
    StreamedRows(const FormFactorEngine& engine, const PatchMesh& mesh)
        : engine_(engine), mesh_(mesh) {}
    bool visit(std::span<const PatchIndex> patches, const Visit& visit) override;

    std::uint64_t rays() const { return rays_; }
    bool open() const { return open_; }
    /// Of the rows so far, before they were closed; reciprocity is not among them.
    ClosureReport closure() const;

  private:
    const FormFactorEngine& engine_;
    const PatchMesh& mesh_;
    std::uint64_t rays_ = 0;
    bool open_ = false;
    ClosureReport report_;
    double area_ = 0.0;
};

/// Share of all pairs that see each other, from a sample of rows [1].
double estimate_density(const FormFactorEngine& engine, const PatchMesh& mesh);

}  // namespace patchlight
