#pragma once

#include "solver/accuracy/light_particles.h"
#include "solver/accuracy/shown_places.h"
#include "solver/display/tree_display.h"

#include <vector>

namespace patchlight {

/// A part of the display of one material: what is shown to be sent back there, and what landed.
struct FluxRegion {
    double area = 0.0;      // [m²]
    double shown = 0.0;     // ∫ Y(ρ H̃) dA [W]
    double landed = 0.0;    // Y(ρ Φ) by particles [W]
    double variance = 0.0;  // of `landed`
    double straight = 0.0;  // of `landed`, straight from lamps [W]
    SurfaceIndex surface = 0;
    PatchIndex patch = 0;          // a patch of it
    Vec3 centre = Vec3::Zero();    // of its last triangle [m]
    double radius = 0.0;           // of that triangle [m]
    bool inside_triangle = false;  // a part of one triangle
};

/// Cuts the display in regions that a part of the particles shows to be of interest: each has about
/// `landings` of them, be it a part of a triangle, where light is bundled, or many triangles, where
/// it is thin. What the other particles bring is compared: they had no say in it.
std::vector<FluxRegion> make_flux_regions(const Scene& scene, const PatchMesh& mesh,
                                          const TreeDisplay& shown, const ShownPlaces& places,
                                          const ParticleFlux& flux, int landings);

/// What the regions prove, and how different both are, beside `norm` [W/m]. Proven: error² >=
/// Σ max(0, |landed - shown| - 2 σ)² / A / norm², by Cauchy and Schwarz.
TransportCheck compare_flux(const std::vector<FluxRegion>& regions, double norm);

}  // namespace patchlight
