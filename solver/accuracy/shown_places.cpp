#include "solver/accuracy/shown_places.h"

#include "solver/display/closer_look.h"

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

std::optional<ShownPlaces::Place> ShownPlaces::find(SurfaceIndex s,
                                                    const RayPoint& position) const {
    const PatchIndex patch = locator_.find(s, position.x(), position.y(), position.z());
    std::uint32_t e = root_of_[patch];
    if (e == RefinementTree::none) return std::nullopt;
    const Vec3& normal = scene_.surfaces[s].normal;
    const Vec3 p = rays_.from_ray_space(position.cast<double>(), rays_.frame(s));
    while (!is_shown(e)) {
        if (tree_.elements()[e].is_leaf()) return std::nullopt;
        e = child_at(tree_, tree_.elements()[e], normal, p);
        if (e == RefinementTree::none) return std::nullopt;
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
