#include "solver/form_factors/close_row.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr double exact_closure = 1e-6;  // a row of exact entries that sums to 1 this well [1]
constexpr double closed_enough = 1e-12;
constexpr int most_rounds = 16;  // each fixes the entries that met a limit

/// A share that may change: its value, how uncertain it is, and how large it can be.
struct Share {
    double* value;
    double variance;
    double most;
};

/// Variance of a share that `rays` told: none if no ray said so, lest a closed room lose light; if
/// all said so though the row sums to something, that of what the row says.
double variance_of(double share, double row_sum, std::uint64_t rays) {
    constexpr double half_a_ray = 0.5;  // short of all is rounding [rays]
    const double n = static_cast<double>(rays);
    const bool all = (1.0 - share) * n < half_a_ray;
    const double rest = all ? std::min(row_sum, 1.0) : 1.0 - share;
    return (1.0 - rest) * rest / n;
}

/// Spreads `deficit` by variance; what an entry cannot take goes to the others. What is left.
double spread(std::vector<Share>& shares, double deficit) {
    for (int round = 0; round < most_rounds && std::abs(deficit) > closed_enough; ++round) {
        double total = 0.0;
        for (const Share& share : shares) total += share.variance;
        if (!(total > 0.0)) break;
        double left = deficit;
        for (Share& share : shares) {
            const double wanted = *share.value + deficit * share.variance / total;
            const double taken = std::clamp(wanted, 0.0, std::max(share.most, *share.value));
            left -= taken - *share.value;
            if (taken != wanted) share.variance = 0.0;
            *share.value = taken;
        }
        deficit = left;
    }
    return deficit;
}

}  // namespace

Outside close_row(const FormFactorEngine& engine, PatchIndex i, FactorRow& row) {
    // A count may give a tiny patch more than reciprocity lets it have.
    for (std::size_t k = 0; k < row.factors.size(); ++k)
        if (row.variance[k] > 0.0) row.factors[k] = std::min(row.factors[k], row.ceiling[k]);
    const double sum = std::accumulate(row.factors.begin(), row.factors.end(), 0.0);
    const bool uncertain = std::any_of(row.variance.begin(), row.variance.end(),
                                       [](double variance) { return variance > 0.0; });
    Outside outside;
    if (row.outside)
        outside = *row.outside;
    else if (uncertain || std::abs(1.0 - sum) > exact_closure)
        outside = engine.outside(i);
    else
        return outside;
    std::vector<Share> shares;
    for (std::size_t k = 0; k < row.factors.size(); ++k)
        if (row.variance[k] > 0.0)
            shares.push_back({&row.factors[k], row.variance[k], row.ceiling[k]});
    if (outside.rays > 0) {
        for (double* share : {&outside.backs, &outside.escaped})
            shares.push_back({share, variance_of(*share, sum, outside.rays), 1.0});
    }
    const double left = spread(shares, 1.0 - sum - outside.backs - outside.escaped);
    // Exact entries, and less light outside than rays tell: it is there all the same.
    if (!uncertain && left > exact_closure) outside.escaped += left;
    return outside;
}

}  // namespace patchlight
