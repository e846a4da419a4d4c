#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/solution.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// The symmetric matrix H_ij = A_i F_ij, upper triangle by rows, in units of the mean patch area;
/// with what is known of each entry's error, and of the light that meets no front.
struct ExchangeMatrix {
    double unit = 1.0;                                     // mean patch area [m²]
    std::vector<double> area;                              // of patches, in units
    std::vector<std::size_t> start;                        // row i is [start[i], start[i + 1])
    std::vector<PatchIndex> column;                        // j > i, ascending
    std::vector<float> exchange;                           // H_ij
    std::vector<float> variance;                           // of H_ij; 0: exact
    std::vector<float> ceiling;                            // H_ij with nothing between
    std::vector<double> backs, escaped;                    // shares of each patch's light [1]
    std::vector<double> backs_variance, escaped_variance;  // of those shares; 0: exact
    ClosureReport measured;  // of the engine's own rows, before the two halves were joined
    std::uint64_t rays = 0;
    bool complete = true;  // false if the observer stopped the work

    std::size_t size() const { return area.size(); }
};

/// Tells the fraction done; false stops the work.
using FractionObserver = std::function<bool(double fraction)>;

/// Asks an engine for all its rows, in parallel, and joins the two halves of each pair: an entry
/// that rays counted from both ends becomes their sum over both, the most likely value.
ExchangeMatrix build_exchange(const FormFactorEngine& engine, const Scene& scene,
                              const PatchMesh& mesh, const FractionObserver& observe);

/// Defects of the matrix as it stands.
ClosureReport measure_closure(const ExchangeMatrix& matrix);

}  // namespace patchlight
