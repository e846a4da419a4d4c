#pragma once

#include "solver/view_factors.h"

#include <string>
#include <vector>

namespace patchlight {

/// View factors, all of them in dense rows, and what was said of them.
struct ViewFactorTable {
    FactorGroups groups;
    std::vector<std::vector<double>> factors;  // 0 where no pair was told of [1]
    std::vector<std::vector<double>> errors;   // one standard error, absolute [1]
    ViewFactorReport report;

    std::size_t size() const { return factors.size(); }
    double row_sum(std::size_t i) const;
    /// Of the group of that name; throws std::out_of_range.
    std::size_t at(const std::string& name) const;
};

ViewFactorTable view_factors(const Scene& scene, const SolveSettings& settings, Grouping grouping,
                             const Observer& observe = {});

/// Settings for a scene of so many patches that keep its pairs from being stored.
SolveSettings with_little_memory(const Scene& scene, double patch_size);

}  // namespace patchlight
