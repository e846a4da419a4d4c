#include "solver/display/near_lights.h"

#include "solver/display/near_places.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

constexpr double farthest = 2.24;  // of an element's radius, off a light: √(2² + 1²) [1]

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

NearLights::NearLights(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                       const std::vector<LightSource>& sources, const ApertureSet& apertures)
    : scene_(scene), mesh_(mesh), near_(mesh.size()) {
    for (const LightSource& source : sources)
        add({source.polygon, source.normal, narrow_side(source.polygon),
             std::numeric_limits<double>::infinity()});
    for (std::size_t g = 0; g < apertures.size(); ++g) {
        const auto to_metres = [&](float u, float v) {
            return rays.from_ray_space(apertures[g].at(u, v).cast<double>());
        };
        for (const double side : {1.0, -1.0}) {  // lit from behind
            const double most = apertures.lit(g)[side > 0.0 ? 1 : 0].irradiance;
            if (!(most > 0.0)) continue;
            Light light{{}, side * apertures[g].normal.cast<double>(), 0.0, most};
            for (const auto& [u, v] : {std::array{0.0f, 0.0f}, std::array{1.0f, 0.0f},
                                       std::array{1.0f, 1.0f}, std::array{0.0f, 1.0f}})
                light.polygon.add(side > 0.0 ? to_metres(u, v) : to_metres(v, u));
            light.width = narrow_side(light.polygon);
            add(light);
        }
    }
    std::vector<Vec3> centres;
    double widest = 0.0;  // radius [m]
    for (const Light& light : lights_) {
        centres.push_back(light.centre);
        widest = std::max(widest, light.radius);
    }
    const NearPlaces tree(std::move(centres));
    tbb::parallel_for(PatchIndex{0}, static_cast<PatchIndex>(mesh.size()), [&](PatchIndex i) {
        const Patch& patch = mesh.patches[i];
        Disc disc{patch.centre, scene.surfaces[patch.surface].normal, 0.0};
        for (const std::uint32_t v : patch.vertices)
            disc.radius = std::max(disc.radius, (mesh.vertices[v] - patch.centre).norm());
        const auto near = tree.nearest(disc.centre, widest + farthest * disc.radius, lights_.size(),
                                       [&](std::uint32_t l) {
                                           return (lights_[l].centre - disc.centre).norm() <=
                                                  lights_[l].radius + farthest * disc.radius;
                                       });
        for (const std::uint32_t l : near)
            if (hides_spot(disc, lights_[l], 0.0)) near_[i].push_back(l);
    });
}

void NearLights::add(const Light& light) {
    lights_.push_back(light);
    Light& added = lights_.back();
    const auto& corners = added.polygon.corners;
    for (std::size_t k = 0; k < added.polygon.size; ++k)
        added.centre += corners[k] / static_cast<double>(added.polygon.size);
    for (std::size_t k = 0; k < added.polygon.size; ++k)
        added.radius = std::max(added.radius, (corners[k] - added.centre).norm());
}

/// What is farther aside than twice the disc's radius, or higher than it, hides none.
bool NearLights::hides_spot(const Disc& disc, const Light& light, double little) {
    const double near = light.radius + farthest * disc.radius;
    if ((light.centre - disc.centre).squaredNorm() > near * near) return false;
    const ConvexPolygon& polygon = light.polygon;
    const Vec3& faces = light.normal;
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
    if (disc.radius <= spot || light.most * spot < little) return false;
    const double distance = distance_to(polygon, faces, disc.centre);
    const double aside = std::sqrt(std::max(0.0, distance * distance - height * height));
    return aside < disc.radius + spot;
}

bool NearLights::may_hide_spot(const RefinementTree& tree, const TreeElement& element,
                               double little) const {
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
                       [&](std::uint32_t l) { return hides_spot(disc, lights_[l], little); });
}

}  // namespace patchlight
