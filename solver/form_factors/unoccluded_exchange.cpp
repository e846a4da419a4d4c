#include "solver/form_factors/unoccluded_exchange.h"

#include "solver/form_factors/contour_exchange.h"
#include "solver/mesh/make_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace patchlight {

namespace {

// Distance over the larger radius beyond which 2, 3 and 4 Gauss points an edge are good to 3e-7 in
// the median over random poses, measured against the contour integral.
struct Reach {
    double two, three, four;
};
constexpr Reach quad_reach{30.0, 9.0, 4.5};
constexpr Reach triangle_reach{60.0, 12.0, 5.0};
constexpr double in_plane = 1e-10;                // of a frame's size: rounding of coordinates [1]
constexpr std::size_t most_tabled_groups = 2048;  // places of planes are tabled up to here

}  // namespace

UnoccludedExchange::UnoccludedExchange(const Scene& scene, const PatchMesh& mesh,
                                       const PlaneGroups& groups)
    : scene_(scene),
      mesh_(mesh),
      tolerance_(scene),
      polygons_(mesh.size()),
      radius_(mesh.size()),
      group_of_(groups.of_surface),
      group_count_(groups.size()),
      points2_(make_patch_points(mesh, 2)),
      points3_(make_patch_points(mesh, 3)),
      points4_(make_patch_points(mesh, 4)) {
    for (PatchIndex i = 0; i < mesh.size(); ++i)
        for (const Vec3& p : patch_corners(mesh, i)) {
            polygons_[i].add(p);
            radius_[i] = std::max(radius_[i], (p - mesh.patches[i].centre).norm());
        }
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        flat_.push_back(tolerance_.rounding(s, in_plane));
    const std::size_t n = groups.size();
    if (n > most_tabled_groups) return;
    group_place_.resize(n * n, Place::cut);
    for (std::size_t g = 0; g < n; ++g)
        for (std::size_t h = 0; h < n; ++h)
            group_place_[g * n + h] =
                g == h ? Place::behind : place_of_group(groups.members[g], groups.members[h]);
}

/// Where all of a group is for all surfaces of another; else `cut`.
UnoccludedExchange::Place UnoccludedExchange::place_of_group(
    const std::vector<SurfaceIndex>& group, const std::vector<SurfaceIndex>& before) const {
    const Surface& plane = scene_.surfaces[before[0]];
    double lowest = 0.0, highest = 0.0, flat = flat_[before[0]];
    for (const SurfaceIndex s : group) {
        flat = std::max(flat, flat_[s]);
        for (const Vec3& p : scene_.surfaces[s].corners) {
            const double height = (p - plane.corners[0]).dot(plane.normal);
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    }
    const auto range = [&](const std::vector<SurfaceIndex>& surfaces) {
        std::array<double, 2> least_and_most{std::numeric_limits<double>::infinity(), 0.0};
        for (const SurfaceIndex s : surfaces) {
            least_and_most[0] = std::min(least_and_most[0], tolerance_.at(s));
            least_and_most[1] = std::max(least_and_most[1], tolerance_.at(s));
        }
        return least_and_most;
    };
    const auto of_group = range(group), of_plane = range(before);
    const double least_contact = 0.5 * std::min(of_group[0], of_plane[0]),
                 most_contact = 0.5 * std::max(of_group[1], of_plane[1]);
    if (highest <= least_contact) return Place::behind;
    return highest > most_contact && lowest >= -flat ? Place::in_front : Place::cut;
}

UnoccludedExchange::Place UnoccludedExchange::place(PatchIndex i, SurfaceIndex of) const {
    if (!group_place_.empty()) {
        const Place tabled =
            group_place_[group_of_[mesh_.patches[i].surface] * group_count_ + group_of_[of]];
        if (tabled != Place::cut) return tabled;
    }
    const Surface& plane = scene_.surfaces[of];
    double lowest = 0.0, highest = 0.0;
    for (const Vec3& p : polygons_[i].view()) {
        const double height = (p - plane.corners[0]).dot(plane.normal);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    const SurfaceIndex own = mesh_.patches[i].surface;
    if (highest <= contact(own, of)) return Place::behind;
    return lowest >= -std::max(flat_[own], flat_[of]) ? Place::in_front : Place::cut;
}

double UnoccludedExchange::clipped(PatchIndex i, PatchIndex j) const {
    const Surface &surface_i = scene_.surfaces[mesh_.patches[i].surface],
                  &surface_j = scene_.surfaces[mesh_.patches[j].surface];
    const ConvexPolygon p = clip_to_front(polygons_[i], surface_j.corners[0], surface_j.normal);
    const ConvexPolygon q = clip_to_front(polygons_[j], surface_i.corners[0], surface_i.normal);
    if (p.size < 3 || q.size < 3) return 0.0;
    const double distance = (mesh_.patches[j].centre - mesh_.patches[i].centre).norm();
    if (distance < triangle_reach.three * std::max(radius_[i], radius_[j]))
        return contour_exchange(p, q);
    return std::max(0.0, kernel_exchange(p, surface_i.normal, q, surface_j.normal));
}

double UnoccludedExchange::operator()(PatchIndex i, PatchIndex j) const {
    const Patch &patch_i = mesh_.patches[i], &patch_j = mesh_.patches[j];
    if (patch_i.surface == patch_j.surface || patch_i.covered || patch_j.covered) return 0.0;
    const Place place_i = place(i, patch_j.surface);
    if (place_i == Place::behind) return 0.0;
    const Place place_j = place(j, patch_i.surface);
    if (place_j == Place::behind) return 0.0;
    if (place_i == Place::cut || place_j == Place::cut) return clipped(i, j);
    const double radius = std::max(radius_[i], radius_[j]);
    const double ratio = (patch_j.centre - patch_i.centre).norm() / radius;
    const Reach& reach =
        patch_i.is_triangle() || patch_j.is_triangle() ? triangle_reach : quad_reach;
    if (ratio < reach.four) return contour_exchange(polygons_[i], polygons_[j]);
    const PatchPoints& points = ratio >= reach.two     ? points2_
                                : ratio >= reach.three ? points3_
                                                       : points4_;
    const Vec3 &normal_i = scene_.surfaces[patch_i.surface].normal,
               &normal_j = scene_.surfaces[patch_j.surface].normal;
    return std::max(0.0, kernel_exchange(points, i, normal_i, j, normal_j));
}

}  // namespace patchlight
