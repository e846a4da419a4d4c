#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"

#include <vector>

namespace patchlight {

/// Uniform points over a patch in ray space, in the frame of its surface: its parallelogram, or its
/// two triangles in proportion to their areas. Points keep clear of the edges by a few steps of
/// float, so that no ray starts on a neighbour.
struct PatchSampler {
    RayPoint corner, first_edge, second_edge;  // of the parallelogram, or of triangle 0-1-2
    RayPoint third_edge;                       // triangle 0-2-3: from corner 0 to 3
    RayPoint centre;                           // centroid
    RayPoint tangent, bitangent, normal;       // right-handed frame
    float first_share = 1.0f;                  // of the area that is triangle 0-1-2
    float margin = 0.0f;  // kept from the edges, a share of the way to the centre [1]
    bool parallelogram = false;
    FrameIndex frame = 0;

    /// (u, v) in [0, 1)² to a point; areas are kept.
    RayPoint at(float u, float v) const;
};

PatchSampler make_sampler(const PatchMesh& mesh, PatchIndex i, const Vec3& normal,
                          const RayScene& rays);

}  // namespace patchlight
