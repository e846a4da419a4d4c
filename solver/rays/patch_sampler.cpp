#include "solver/rays/patch_sampler.h"

#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {
constexpr double clear_of_edge = 3.4;  // steps of float
constexpr double largest_margin = 0.02;
constexpr double parallelogram_misfit = 1e-6;  // of its size [1]
}  // namespace

PatchSampler make_sampler(const PatchMesh& mesh, PatchIndex i, const Vec3& normal,
                          const RayScene& rays) {
    const Patch& patch = mesh.patches[i];
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.vertices[patch.vertices[k]];
    PatchSampler sampler;
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], e3 = p[3] - p[0];
    const double scale = rays.scale();
    sampler.parallelogram =
        !patch.is_triangle() && (e1 + e3 - e2).norm() <= parallelogram_misfit * e2.norm();
    sampler.frame = rays.frame(patch.surface);
    sampler.corner = rays.to_ray_space(p[0], sampler.frame);
    sampler.first_edge = (e1 * scale).cast<float>();
    sampler.second_edge = ((sampler.parallelogram ? e3 : e2) * scale).cast<float>();
    sampler.third_edge = (e3 * scale).cast<float>();
    const double first = e1.cross(e2).dot(normal), second = e2.cross(e3).dot(normal);
    sampler.first_share = patch.is_triangle() ? 1.0f : static_cast<float>(first / (first + second));
    double clear =
        std::numeric_limits<double>::infinity();  // of the centre from the nearest edge [m]
    for (std::size_t k = 0; k < patch.corner_count(); ++k) {
        const Vec3 along = p[(k + 1) % patch.corner_count()] - p[k];
        clear = std::min(clear, along.normalized().cross(patch.centre - p[k]).norm());
    }
    sampler.centre = rays.to_ray_space(patch.centre, sampler.frame);
    sampler.margin = static_cast<float>(
        std::min(largest_margin, clear_of_edge * rays.step(patch.surface) / (clear * scale)));
    const PlaneFrame frame = frame_along(Vec3::Zero(), e1, normal);
    sampler.tangent = frame.u.cast<float>();
    sampler.bitangent = frame.v.cast<float>();
    sampler.normal = normal.cast<float>();
    return sampler;
}

RayPoint PatchSampler::at(float u, float v) const {
    if (parallelogram) {
        const auto inside = [&](float t) { return margin + (1.0f - 2.0f * margin) * t; };
        return corner + inside(u) * first_edge + inside(v) * second_edge;
    }
    const bool in_first = u < first_share;
    const float s = in_first ? u / first_share : (u - first_share) / (1.0f - first_share);
    const float root = std::sqrt(s);  // Turk, "Generating Random Points in Triangles", 1990
    const RayPoint& near_edge = in_first ? first_edge : second_edge;
    const RayPoint& far_edge = in_first ? second_edge : third_edge;
    const RayPoint p = corner + root * (1.0f - v) * near_edge + root * v * far_edge;
    return p + margin * (centre - p);
}

}  // namespace patchlight
