#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/solution.h"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace patchlight {

/// A row that obeys closure, as a solver without a matrix uses it.
struct ClosedRow {
    std::vector<PatchIndex> columns;
    std::vector<float> factors;  // F_ij [1]
    Outside outside;
};

/// What shooting may keep of the rows it asked for: the brightest patches shoot again and again.
constexpr std::size_t kept_row_bytes = std::size_t{64} << 20;

/// Rows on demand. Those asked for first, the brightest, are kept as long as they fit in `bytes`;
/// others are computed anew each time.
class RowSource {
  public:
    RowSource(const FormFactorEngine& engine, std::size_t patches, std::size_t bytes);

    /// Rows of the given patches, computed in parallel; good until the next call.
    std::vector<const ClosedRow*> fetch(std::span<const PatchIndex> patches);

    std::uint64_t rays() const { return rays_; }
    std::size_t computed() const { return computed_; }  // rows, repeated ones counted again
    std::size_t bytes() const { return kept_bytes_; }   // held at present
    /// Defects of all rows seen so far, before they were closed; their mean is not area-weighted.
    ClosureReport closure() const;
    /// The same of the rows as they are used: closed.
    ClosureReport closed() const { return report(closed_); }

  private:
    struct Sums {
        double total = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
        void note(double sum);
    };
    ClosureReport report(const Sums& sums) const;

    const FormFactorEngine& engine_;
    std::size_t budget_, kept_bytes_ = 0, computed_ = 0, seen_count_ = 0;
    std::uint64_t rays_ = 0;
    std::vector<std::unique_ptr<ClosedRow>> kept_;  // per patch; empty if not kept
    std::vector<ClosedRow> passing_;                // of the last call
    std::vector<bool> seen_;
    Sums given_, closed_;  // of rows as the engine gave them, and as they are used
    double worst_defect_ = 0.0;
};

}  // namespace patchlight
