#pragma once

#include "solver/form_factors/form_factor_matrix.h"

#include <functional>
#include <optional>
#include <vector>

namespace patchlight {

/// One quantity on every patch, for each channel in use: one if the scene is grey, else three.
using Field = std::vector<std::vector<double>>;

/// B = E + ρ F B on the patches of a mesh. ρ stands with the gathering patch: B_i = E_i + ρ_i Σ_j
/// F_ij B_j.
struct RadiosityProblem {
    const FormFactorMatrix& factors;
    std::vector<double> area;  // [m²]
    Field exitance;            // E [W/m²]
    Field reflectance;         // ρ [1]

    std::size_t size() const { return area.size(); }
    std::size_t channels() const { return exitance.size(); }
};

/// The channel's share in the luminance of a triple; 1 if it stands for all three.
double luminance_weight(std::size_t channel, std::size_t channels);

}  // namespace patchlight
