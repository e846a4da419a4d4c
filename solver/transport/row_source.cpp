#include "solver/transport/row_source.h"

#include "solver/form_factors/close_row.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

struct Made {
    ClosedRow row;
    std::uint64_t rays = 0;
    double sum = 0.0, defect = 0.0;  // of the row as the engine gave it
    double closed_sum = 0.0;         // as it is used
};

Made make_row(const FormFactorEngine& engine, PatchIndex i) {
    FactorRow row;
    engine.whole_row(i, row);
    Made made;
    made.sum = std::accumulate(row.factors.begin(), row.factors.end(), 0.0);
    const bool told = row.outside.has_value();
    const Outside before = row.outside.value_or(Outside{});
    made.row.outside = close_row(engine, i, row);
    const Outside& away = told ? before : made.row.outside;
    made.defect = std::abs(made.sum + away.backs + away.escaped - 1.0);
    made.closed_sum = std::accumulate(row.factors.begin(), row.factors.end(), 0.0);
    made.rays = row.rays + (told ? 0 : made.row.outside.rays);
    made.row.columns = std::move(row.columns);
    made.row.factors.assign(row.factors.begin(), row.factors.end());
    return made;
}

std::size_t size_of(const ClosedRow& row) {
    return sizeof(ClosedRow) + row.columns.capacity() * sizeof(PatchIndex) +
           row.factors.capacity() * sizeof(float);
}

}  // namespace

RowSource::RowSource(const FormFactorEngine& engine, std::size_t patches, std::size_t bytes)
    : engine_(engine), budget_(bytes), kept_(patches), seen_(patches, false) {}

void RowSource::Sums::note(double sum) {
    total += sum;
    least = std::min(least, sum);
    most = std::max(most, sum);
}

ClosureReport RowSource::report(const Sums& sums) const {
    if (seen_count_ == 0) return {};
    return {sums.least, sums.most, sums.total / static_cast<double>(seen_count_), 0.0, 0.0};
}

std::vector<const ClosedRow*> RowSource::fetch(std::span<const PatchIndex> patches) {
    std::vector<Made> made(patches.size());
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t k) {
        if (!kept_[patches[k]]) made[k] = make_row(engine_, patches[k]);
    });
    passing_.clear();
    passing_.reserve(patches.size());
    std::vector<const ClosedRow*> rows;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        std::unique_ptr<ClosedRow>& kept = kept_[patches[k]];
        if (!kept) {
            ++computed_;
            rays_ += made[k].rays;
            if (!seen_[patches[k]]) {
                seen_[patches[k]] = true;
                ++seen_count_;
                given_.note(made[k].sum);
                closed_.note(made[k].closed_sum);
                worst_defect_ = std::max(worst_defect_, made[k].defect);
            }
            const std::size_t size = size_of(made[k].row);
            if (kept_bytes_ + size > budget_) {
                passing_.push_back(std::move(made[k].row));
                rows.push_back(&passing_.back());
                continue;
            }
            kept_bytes_ += size;
            kept = std::make_unique<ClosedRow>(std::move(made[k].row));
        }
        rows.push_back(kept.get());
    }
    return rows;
}

ClosureReport RowSource::closure() const {
    ClosureReport as_given = report(given_);
    as_given.closure_max = worst_defect_;
    return as_given;
}

}  // namespace patchlight
