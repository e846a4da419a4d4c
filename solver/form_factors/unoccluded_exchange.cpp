#include "solver/form_factors/unoccluded_exchange.h"

#include "solver/form_factors/contour_exchange.h"
#include "solver/mesh/make_patches.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

// Distance over the larger radius beyond which 2, 3 and 4 Gauss points an edge are good to 3e-7 in
// the median over random poses, measured against the contour integral.
struct Reach {
    double two, three, four;
};
constexpr Reach quad_reach{30.0, 9.0, 4.5};
constexpr Reach triangle_reach{60.0, 12.0, 5.0};
constexpr double in_plane = 1e-10;  // of the scene's size: rounding of coordinates [1]
constexpr std::size_t most_tabled_groups = 2048;  // places of planes are tabled up to here

}  // namespace

UnoccludedExchange::UnoccludedExchange(const Scene& scene, const PatchMesh& mesh,
                                       const PlaneGroups& groups)
    : scene_(scene),
      mesh_(mesh),
      flat_(in_plane * scene_size(scene)),
      contact_(0.5 * contact_distance(scene)),
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
    const std::size_t n = groups.size();
    if (n > most_tabled_groups) return;
    group_place_.resize(n * n, Place::cut);
    for (std::size_t g = 0; g < n; ++g)
        for (std::size_t h = 0; h < n; ++h) {
            const Surface& plane = scene.surfaces[groups.members[h][0]];
            double lowest = 0.0, highest = 0.0;
            for (const SurfaceIndex s : groups.members[g])
                for (const Vec3& p : scene.surfaces[s].corners) {
                    const double height = (p - plane.corners[0]).dot(plane.normal);
                    lowest = std::min(lowest, height);
                    highest = std::max(highest, height);
                }
            if (highest <= contact_ || g == h)
                group_place_[g * n + h] = Place::behind;
            else if (lowest >= -flat_)
                group_place_[g * n + h] = Place::in_front;
        }
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
    return highest <= contact_ ? Place::behind : lowest >= -flat_ ? Place::in_front : Place::cut;
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
