#pragma once

#include "solver/accuracy/flux_regions.h"

#include <limits>

namespace patchlight {

/// What a displayed field is checked with from the other end.
struct ParticleEffort {
    double target = 0.01;    // relative error that should show [1]
    std::uint64_t rays = 0;  // about as many, and no more than show that
    /// Time there is for them, about: no more, whatever they leave in doubt.
    double seconds = std::numeric_limits<double>::infinity();
    double norm = 0.0;  // √∫ Y(B - E)² dA [W/m]
    double area = 0.0;  // of all fronts [m²]
};

struct ParticleEvidence {
    TransportCheck check;
    std::vector<FluxRegion> regions;
};

/// Sends particles out from all that gives off light and compares the flux that lands with the flux
/// that is displayed. Where a lamp's particles agree, n of n, about 3/n of its light may go
/// elsewhere: `doubt` is the error if that lands anywhere, spread over all there is. Of several
/// lamps the one that leaves most counts: fluxes F_l that no particle of power φ_l met do so with a
/// chance of exp(-Σ F_l / φ_l), so that F = Σ F_l > 3 max φ_l has less than 5 %.
ParticleEvidence check_transport(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                                 const ApertureSet& apertures, const TreeDisplay& shown,
                                 const ShownPlaces& places, const ParticleEffort& effort,
                                 std::uint64_t seed);

}  // namespace patchlight
