#include "solver/display/near_lights.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

double distance_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (a + t * along - p).norm();
}

double distance_to(const ConvexPolygon& polygon, const Vec3& normal, const Vec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    bool above = true;
    for (std::size_t k = 0; k < polygon.size; ++k) {
        const Vec3 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.size];
        nearest = std::min(nearest, distance_to_edge(p, a, b));
        above = above && (b - a).cross(p - a).dot(normal) >= 0.0;
    }
    return above ? std::abs((p - polygon.corners[0]).dot(normal)) : nearest;
}

}  // namespace

NearLights::NearLights(const Scene& scene, const PatchMesh& mesh,
                       const std::vector<LightSource>& sources)
    : scene_(scene), mesh_(mesh), near_(mesh.size()) {
    for (const LightSource& source : sources) {
        Light light{&source, narrow_side(source.polygon), Vec3::Zero(), 0.0};
        const auto& corners = source.polygon.corners;
        for (std::size_t k = 0; k < source.polygon.size; ++k)
            light.centre += corners[k] / static_cast<double>(source.polygon.size);
        for (std::size_t k = 0; k < source.polygon.size; ++k)
            light.radius = std::max(light.radius, (corners[k] - light.centre).norm());
        lights_.push_back(light);
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        Disc disc{patch.centre, scene.surfaces[patch.surface].normal, 0.0};
        for (const std::uint32_t v : patch.vertices)
            disc.radius = std::max(disc.radius, (mesh.vertices[v] - patch.centre).norm());
        for (std::uint32_t l = 0; l < lights_.size(); ++l)
            if (hides_spot(disc, lights_[l])) near_[i].push_back(l);
    }
}

/// What is farther aside than twice the disc's radius, or higher than it, hides none.
bool NearLights::hides_spot(const Disc& disc, const Light& light) {
    constexpr double farthest = 2.24;  // √(2² + 1²)
    const double near = light.radius + farthest * disc.radius;
    if ((light.centre - disc.centre).squaredNorm() > near * near) return false;
    const ConvexPolygon& polygon = light.source->polygon;
    const Vec3& faces = light.source->normal;
    const double reach = disc.radius * disc.normal.cross(faces).norm();
    if ((disc.centre - polygon.corners[0]).dot(faces) + reach <= 0.0) return false;  // behind it
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < polygon.size; ++k) {
        const double height = (polygon.corners[k] - disc.centre).dot(disc.normal);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    if (high <= 0.0) return false;
    const double height = std::max(low, 0.0), spot = std::max(height, 0.5 * light.width);
    if (disc.radius <= spot) return false;
    const double distance = distance_to(polygon, faces, disc.centre);
    const double aside = std::sqrt(std::max(0.0, distance * distance - height * height));
    return aside < disc.radius + spot;
}

bool NearLights::may_hide_spot(const RefinementTree& tree, const TreeElement& element) const {
    const std::vector<std::uint32_t>& near = near_[element.patch];
    if (near.empty()) return false;
    Disc disc{Vec3::Zero(), scene_.surfaces[mesh_.patches[element.patch].surface].normal, 0.0};
    const std::size_t n = element.corner_count();
    for (std::size_t k = 0; k < n; ++k)
        disc.centre += tree.vertices()[element.vertices[k]].position / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k)
        disc.radius = std::max(
            disc.radius, (tree.vertices()[element.vertices[k]].position - disc.centre).norm());
    return std::any_of(near.begin(), near.end(),
                       [&](std::uint32_t l) { return hides_spot(disc, lights_[l]); });
}

}  // namespace patchlight
