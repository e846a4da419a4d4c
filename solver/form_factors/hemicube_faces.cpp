#include "solver/form_factors/hemicube_faces.h"

#include "solver/form_factors/hemicube_view.h"
#include "solver/rays/patch_locator.h"
#include "solver/rays/patch_sampler.h"

#include <Eigen/Geometry>

#include <cmath>

namespace patchlight {

namespace {

/// As a share of the patch's edge: what is nearer is not seen.
constexpr double near_depth_share = 1e-6;

HemicubePose pose_at_centre(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                            PatchIndex i) {
    const Patch& patch = mesh.patches[i];
    const PatchSampler sampler = make_sampler(mesh, i, scene.surfaces[patch.surface].normal, rays);
    HemicubePose pose;
    pose.normal = sampler.normal.cast<double>().normalized();
    pose.frame = sampler.frame;
    pose.eye = sampler.centre.cast<double>() + rays.shift(sampler.frame, 0) +
               static_cast<double>(rays.lift(patch.surface)) * pose.normal;
    const Vec3 edge = mesh.vertices[patch.vertices[1]] - mesh.vertices[patch.vertices[0]];
    pose.bitangent = pose.normal.cross(edge).normalized();
    pose.tangent = pose.bitangent.cross(pose.normal);
    pose.near_depth = near_depth_share * std::sqrt(patch.area) * rays.scale();
    return pose;
}

}  // namespace

std::array<HemicubeFace, 5> hemicube_faces(const Scene& scene, const PatchMesh& mesh,
                                           const RayScene& rays, PatchIndex i, int resolution) {
    const HemicubeCells cells(resolution);
    std::array<HemicubeFace, 5> faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        faces[f].width = cells.width();
        faces[f].height = f == 0 ? cells.width() : cells.side_height();
        faces[f].delta_factors = f == 0 ? cells.top() : cells.side();
        faces[f].seen.assign(faces[f].delta_factors.size(), HemicubeFace::nothing);
    }
    if (mesh.patches[i].covered) return faces;
    const HemicubeScene drawn(scene, rays);
    const PatchLocator locator(scene, mesh, rays);
    HemicubeView view(drawn, cells, rays);
    view.look_through(pose_at_centre(scene, mesh, rays, i), [&](int face, std::size_t cell, double,
                                                                const HemicubeSight* sight) {
        if (!sight) return;
        const Eigen::Vector3f p =
            (sight->point - rays.shift(rays.frame(sight->surface), 0)).cast<float>();
        faces[static_cast<std::size_t>(face)].seen[cell] =
            sight->front ? locator.find(sight->surface, p.x(), p.y(), p.z()) : HemicubeFace::back;
    });
    return faces;
}

}  // namespace patchlight
