#include "solver/display/closer_look.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

namespace patchlight {

namespace {

constexpr int most_cuts = 4;  // of the leaf that a miss was found in, one below the other

/// How far a point is from the nearest edge; below 0 outside [m].
double depth_inside(const RefinementTree& tree, const TreeElement& element, const Vec3& normal,
                    const Vec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t n = element.corner_count();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = tree.vertices()[element.vertices[k]].position,
                   &b = tree.vertices()[element.vertices[(k + 1) % n]].position;
        const Vec3 along = b - a;
        const double length = along.norm();
        if (length > 0.0) nearest = std::min(nearest, along.cross(p - a).dot(normal) / length);
    }
    return nearest;
}

}  // namespace

std::uint32_t child_at(const RefinementTree& tree, const TreeElement& element, const Vec3& normal,
                       const Vec3& point) {
    const std::uint32_t first = element.first_child;
    std::uint32_t found = RefinementTree::none;
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t child = first; child < first + 4 && most < 0.0; ++child) {
        const double depth = depth_inside(tree, tree.elements()[child], normal, point);
        if (!(depth > most)) continue;
        most = depth;
        found = child;
    }
    return found;
}

CloserLook::CloserLook(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree)
    : scene_(scene), mesh_(mesh), root_of_(mesh.size(), RefinementTree::none) {
    for (std::uint32_t e = 0; e < tree.elements().size() && tree.elements()[e].level == 0; ++e)
        root_of_[tree.elements()[e].patch] = e;
}

template <typename StopsAt>
std::uint32_t CloserLook::descend(const RefinementTree& tree, const PointMiss& point,
                                  const StopsAt& stops_at) const {
    const Vec3& normal = scene_.surfaces[mesh_.patches[point.patch].surface].normal;
    std::uint32_t e = root_of_[point.patch];
    while (e != RefinementTree::none && !stops_at(e))
        e = tree.elements()[e].is_leaf()
                ? RefinementTree::none
                : child_at(tree, tree.elements()[e], normal, point.position);
    return e;
}

void CloserLook::add(const RefinementTree& tree, std::span<const PointMiss> points,
                     const std::function<bool(const TreeElement&)>& is_cut) {
    for (const PointMiss& point : points) {
        const std::uint32_t leaf = descend(tree, point, [&](std::uint32_t e) {
            const TreeElement& element = tree.elements()[e];
            return element.is_leaf() || !is_cut(element);
        });
        if (leaf != RefinementTree::none) places_.push_back({point, tree.elements()[leaf].level});
    }
}

/// Linear between the leaf's corners.
bool CloserLook::still_missed(const RefinementTree& tree, const TreeElement& leaf,
                              const PointMiss& point, std::span<const Rgb> values) const {
    const Surface& surface = scene_.surfaces[mesh_.patches[point.patch].surface];
    const auto at = [&](std::size_t k) -> const Vec3& {
        return tree.vertices()[leaf.vertices[k]].position;
    };
    // Of the two triangles of a quad the one on whose side of the diagonal it is.
    const bool beyond = !leaf.is_triangle() &&
                        (at(2) - at(0)).cross(point.position - at(0)).dot(surface.normal) > 0.0;
    const std::array<std::size_t, 3> corner = {0, beyond ? 2u : 1u, beyond ? 3u : 2u};
    Rgb shown = Rgb::Zero();
    double whole = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = at(corner[(k + 1) % 3]), &b = at(corner[(k + 2) % 3]);
        const double weight = std::max(0.0, (b - a).cross(point.position - a).dot(surface.normal));
        shown += weight * values[leaf.vertices[corner[k]]];
        whole += weight;
    }
    if (!(whole > 0.0)) return false;
    const Rgb& reflectance = scene_.materials[surface.material].reflectance;
    const double missed = luminance(reflectance * (shown / whole - point.irradiance));
    return missed * missed > 0.25 * point.square;
}

void CloserLook::each(const RefinementTree& tree, std::span<const Rgb> values,
                      const std::function<bool(std::uint32_t)>& is_leaf,
                      const std::function<void(std::uint32_t, double)>& at) const {
    for (const Place& place : places_) {
        const std::uint32_t leaf = descend(tree, place.point, is_leaf);
        if (leaf == RefinementTree::none) continue;
        const TreeElement& element = tree.elements()[leaf];
        if (element.level < place.level + most_cuts &&
            still_missed(tree, element, place.point, values))
            at(leaf, place.point.square);
    }
}

}  // namespace patchlight
