#include "solver/findings/overlaps.h"

#include "solver/scene/finding_words.h"
#include "solver/scene/local_tolerance.h"
#include "solver/scene/seen_area.h"

#include <algorithm>
#include <map>
#include <utility>

namespace patchlight {

namespace {

struct OverlapSearch {
    const Scene& scene;
    LocalTolerance tolerance;
    std::vector<double> seen_of_object;  // [m²]

    OverlapSearch(const Scene& of, const CoplanarOverlaps& overlaps)
        : scene(of), tolerance(of), seen_of_object(of.objects.size(), 0.0) {
        const std::vector<double> seen = seen_areas(scene, overlaps);
        for (SurfaceIndex s = 0; s < seen.size(); ++s)
            seen_of_object[scene.surfaces[s].object] += seen[s];
    }

    bool is_given_twice(SurfaceIndex above, SurfaceIndex below) const {
        const std::vector<Vec3>&corners = scene.surfaces[above].corners,
              &others = scene.surfaces[below].corners;
        const double reach = tolerance.between(above, below);
        const auto among = [reach](const Vec3& p, const std::vector<Vec3>& places) {
            return std::any_of(places.begin(), places.end(),
                               [&](const Vec3& q) { return (p - q).norm() <= reach; });
        };
        return corners.size() == others.size() &&
               std::all_of(corners.begin(), corners.end(),
                           [&](const Vec3& p) { return among(p, others); });
    }

    bool is_whole(SurfaceIndex covered) const {
        return !(seen_of_object[scene.surfaces[covered].object] > 0.0);
    }
    bool gives_light(SurfaceIndex covered) const {
        return (scene.materials[scene.surfaces[covered].material].exitance > 0.0).any();
    }
    bool is_told(SurfaceIndex cover, SurfaceIndex covered) const {
        return is_whole(covered) || gives_light(covered) || is_given_twice(cover, covered);
    }

    Finding finding(SurfaceIndex cover, SurfaceIndex covered) const {
        const Surface &above = scene.surfaces[cover], &below = scene.surfaces[covered];
        const std::string &top = scene.objects[above.object].name,
                          &bottom = scene.objects[below.object].name;
        const bool same = top == bottom, twice = is_given_twice(cover, covered),
                   emits = gives_light(covered), whole = is_whole(covered);
        const Surface& smaller = above.area < below.area ? above : below;
        const std::string place =
            place_text(centroid(smaller.corners, smaller.normal), tolerance.frame(covered).size());
        Finding found{"coplanar-overlap", {top}, "", "", 1};
        if (!same) found.objects.push_back(bottom);
        if (twice) {
            found.detail = (same ? "a face of " + quoted(top) + " is given twice"
                                 : quoted(top) + " and " + quoted(bottom) + " share a face") +
                           " near " + place + ": it counts once, " +
                           (same ? "as it is listed last" : "as one of " + quoted(top));
            found.remedy = "leave one of them out";
            return found;
        }
        found.detail = (same ? "a polygon of " + quoted(top) + " lies in the plane of another of it"
                             : quoted(top) + " lies in the plane of " + quoted(bottom)) +
                       " and, being listed later, covers " +
                       (whole   ? "all of it"
                        : emits ? "what gives off light"
                                : "it") +
                       " near " + place;
        if (emits) found.detail += ": what is covered gives off nothing";
        found.remedy =
            "list it before what it covers, or raise what shall be seen by more than 1e-6 of its "
            "size";
        return found;
    }
};

}  // namespace

std::vector<Finding> overlap_findings(const Scene& scene, const CoplanarOverlaps& overlaps) {
    const OverlapSearch search(scene, overlaps);
    std::map<std::pair<ObjectIndex, ObjectIndex>, std::size_t> number_of;
    std::vector<Finding> findings;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        for (const SurfaceIndex cover : overlaps.covered_by[s]) {
            if (!search.is_told(cover, s)) continue;
            const auto [known, is_new] = number_of.emplace(
                std::pair(scene.surfaces[cover].object, scene.surfaces[s].object), findings.size());
            if (is_new)
                findings.push_back(search.finding(cover, s));
            else
                ++findings[known->second].count;
        }
    return findings;
}

}  // namespace patchlight
