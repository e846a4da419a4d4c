#pragma once

#include "solver/form_factors/convex_polygon.h"
#include "solver/mesh/make_patches.h"
#include "solver/rays/patch_sampler.h"

#include <vector>

namespace patchlight {

/// A convex polygon that gives off light by itself, whole as far as nothing covers it.
struct LightSource {
    ConvexPolygon polygon;  // [m]
    Vec3 normal = Vec3::UnitZ();
    PatchSampler sampler;  // of its points, in the frame of its surface
    float lift = 0.0f;     // that its points start above it [ray space]
    SurfaceIndex surface = 0;
    Rgb exitance = Rgb::Zero();  // [W/m²]
    double area = 0.0;           // [m²]
    double power = 0.0;          // area times luminance of the exitance [W]
};

/// The emitting polygons of a scene, most powerful first, and `most` of them; surfaces that are not
/// wholly among them are left out altogether.
std::vector<LightSource> find_light_sources(const Scene& scene, const MeshLines& lines,
                                            const RayScene& rays, std::size_t most);

/// Area over the longest distance of two corners [m].
double narrow_side(const ConvexPolygon& polygon);

}  // namespace patchlight
