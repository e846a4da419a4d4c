#include "solver/accuracy/shown_places.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace patchlight {

ShownPlaces::ShownPlaces(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                         const PatchLocator& locator, const RefinementTree& tree,
                         const TreeDisplay& shown)
    : scene_(scene),
      rays_(rays),
      locator_(locator),
      tree_(tree),
      shown_(shown),
      root_of_(mesh.size(), RefinementTree::none) {
    for (std::uint32_t e = 0; e < tree.elements().size() && tree.elements()[e].level == 0; ++e)
        root_of_[tree.elements()[e].patch] = e;
}

bool ShownPlaces::is_shown(std::uint32_t element) const {
    return element + 1 < shown_.first_triangle.size() &&
           shown_.first_triangle[element + 1] > shown_.first_triangle[element];
}

/// How far a point is from the nearest edge; below 0 outside [m].
double ShownPlaces::inside(const TreeElement& element, const Vec3& normal, const Vec3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t n = element.corner_count();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = tree_.vertices()[element.vertices[k]].position,
                   &b = tree_.vertices()[element.vertices[(k + 1) % n]].position;
        const Vec3 along = b - a;
        const double length = along.norm();
        if (length > 0.0) nearest = std::min(nearest, along.cross(p - a).dot(normal) / length);
    }
    return nearest;
}

std::optional<ShownPlaces::Place> ShownPlaces::find(SurfaceIndex s,
                                                    const RayPoint& position) const {
    const PatchIndex patch = locator_.find(s, position.x(), position.y(), position.z());
    std::uint32_t e = root_of_[patch];
    if (e == RefinementTree::none) return std::nullopt;
    const Vec3& normal = scene_.surfaces[s].normal;
    const Vec3 p = rays_.from_ray_space(position.cast<double>(), rays_.frame(s));
    while (!is_shown(e)) {
        const std::uint32_t first = tree_.elements()[e].first_child;
        if (first == 0) return std::nullopt;
        double most = -std::numeric_limits<double>::infinity();
        for (std::uint32_t child = first; child < first + 4 && most < 0.0; ++child) {
            const double depth = inside(tree_.elements()[child], normal, p);
            if (!(depth > most)) continue;
            most = depth;
            e = child;
        }
        if (e < first) return std::nullopt;
    }
    std::optional<Place> best;
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::uint32_t t = shown_.first_triangle[e]; t < shown_.first_triangle[e + 1]; ++t) {
        const auto& corners = shown_.display.triangles[t];
        const auto at = [&](std::size_t k) { return shown_.display.positions[corners[k % 3]]; };
        const double whole = (at(1) - at(0)).cross(at(2) - at(0)).dot(normal);
        if (!(whole > 0.0)) continue;
        Place place{t, {}};
        for (std::size_t k = 0; k < 2; ++k)
            place.weight[k] = (at(k + 2) - at(k + 1)).cross(p - at(k + 1)).dot(normal) / whole;
        place.weight[2] = 1.0 - place.weight[0] - place.weight[1];
        const double least = *std::min_element(place.weight.begin(), place.weight.end());
        if (!(least > deepest)) continue;
        deepest = least;
        best = place;
    }
    if (!best) return std::nullopt;
    double sum = 0.0;
    for (double& weight : best->weight) sum += weight = std::max(0.0, weight);
    for (double& weight : best->weight) weight /= sum;
    return best;
}

}  // namespace patchlight
