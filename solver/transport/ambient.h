#pragma once

#include "solver/transport/radiosity_problem.h"

#include <vector>

namespace patchlight {

/// What is known of a scene's surfaces, for all light that has not been followed yet.
struct AmbientScene {
    const std::vector<double>& area;         // [m²]
    const Field& reflectance;                // [1]
    const std::vector<double>& front_share;  // of a patch's light that meets fronts [1]
};

/// Irradiance that the unshot light would bring, spread as if every patch saw the same mean
/// surroundings: the ambient term of Cohen, Chen, Wallace & Greenberg, "A progressive refinement
/// approach", 1988, with the light counted that leaves the scene. Per channel, with s the front
/// shares and ρ' = Σ A ρ s² / Σ A s, every patch lies in surroundings of radiosity
/// G = Σ A ΔB s / (Σ A s · (1 − ρ')) and receives s G. In a closed scene s = 1, which is the term
/// of 1988: 1 / (1 − ρ') is the interreflection factor of the area-weighted reflectance. For
/// display only; it is no part of the solution [W/m²].
Field ambient_irradiance(const AmbientScene& scene, const Field& unshot);

}  // namespace patchlight
