#include "solver/findings/openings.h"

#include "solver/findings/light_test.h"
#include "solver/findings/surface_tree.h"
#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

namespace patchlight {

namespace {

constexpr std::size_t walks = 8'192;
constexpr int flights = 4;
constexpr double open_share = 0.03;  // of flights that escape: an open scene [1]
constexpr std::size_t fewest = 12;   // escapes that are no accident
constexpr double slit_reach = 3.0;   // gap widths: what passes an edge nearer got out beside it [1]
constexpr std::size_t holes_named = 3;

struct Escape {
    Vec3 origin, direction;  // [m], unit
};

struct Escapes {
    std::vector<Escape> all;
    std::size_t flights = 0;
};

/// Flights of light under way. The first, straight from lamps, are not counted: a lamp may be made
/// to shine out.
Escapes follow_light(const FlawSearch& search) {
    const LightTest light(search);

    std::vector<Walker> walkers;
    for (const SurfaceIndex s : draw(light.power(), walks, search.seed)) {
        const std::uint64_t seed = mix(search.seed, walkers.size());
        walkers.push_back(
            leave(search, s, SurfacePoints(search.scene.surfaces[s]).at(seed), Side::front, seed));
    }
    Escapes escapes;
    fly(search.rays, walkers);
    for (int flight = 0; flight < flights; ++flight) {
        turn(search, walkers);
        fly(search.rays, walkers);
        for (const Walker& walker : walkers) {
            escapes.flights += walker.flying;
            if (walker.flying && walker.landing == Landing::escaped)
                escapes.all.push_back(
                    {search.rays.from_ray_space(walker.origin.cast<double>(), walker.frame),
                     walker.direction.cast<double>()});
        }
    }
    return escapes;
}

/// Whether light passes near the edge.
bool goes_through(const Escape& escape, const Slit& slit) {
    const Vec3 along = slit.to - slit.from, start = escape.origin - slit.from;
    const Vec3 across = escape.direction.cross(along);
    const double t = escape.direction.cross(start).dot(across) / across.squaredNorm();
    const Vec3 nearest = slit.from + std::clamp(t, 0.0, 1.0) * along;
    return (nearest - escape.origin).cross(escape.direction).norm() <= slit_reach * slit.width;
}

/// The point nearest to all the lines, in the mean of squares.
Vec3 focus(std::span<const Escape> escapes) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    for (const Escape& escape : escapes) {
        Eigen::Matrix3d across =
            Eigen::Matrix3d::Identity() - escape.direction * escape.direction.transpose();
        sum += across;
        right += across * (escape.origin - escapes[0].origin);
    }
    return escapes[0].origin + sum.ldlt().solve(right);
}

Vec3 nearest_to(const Escape& escape, const Vec3& p) {
    return escape.origin + (p - escape.origin).dot(escape.direction) * escape.direction;
}

/// Objects round a hole: those nearest to where light passes it.
std::vector<std::string> rim(const FlawSearch& search, std::span<const Escape> escapes,
                             const Vec3& middle) {
    const SurfaceTree tree(search.scene);
    std::map<std::string, int> counts;
    for (std::size_t k = 0; k < std::min<std::size_t>(escapes.size(), 64); ++k) {
        const Vec3 at = nearest_to(escapes[k], middle);
        const double size = search.size_at(at);
        for (double reach = 0.01 * size; reach < size; reach *= 2.0) {
            const auto near = tree.within(at, reach);
            if (near.empty()) continue;
            const auto least = std::min_element(
                near.begin(), near.end(),
                [](const auto& a, const auto& b) { return a.distance < b.distance; });
            ++counts[search.object_of(least->surface)];
            break;
        }
    }
    std::vector<std::pair<int, std::string>> order;
    for (const auto& [name, count] : counts) order.emplace_back(-count, name);
    std::sort(order.begin(), order.end());
    std::vector<std::string> names;
    for (std::size_t k = 0; k < std::min(order.size(), holes_named); ++k)
        names.push_back(order[k].second);
    return names;
}

}  // namespace

std::vector<Finding> find_openings(const FlawSearch& search, std::span<const Slit> slits) {
    Escapes escapes = follow_light(search);
    std::erase_if(escapes.all, [&](const Escape& escape) {
        return std::any_of(slits.begin(), slits.end(),
                           [&](const Slit& slit) { return goes_through(escape, slit); });
    });
    const double share = static_cast<double>(escapes.all.size()) /
                         static_cast<double>(std::max<std::size_t>(1, escapes.flights));
    if (escapes.all.size() < fewest || share > open_share) return {};
    const Vec3 middle = focus(escapes.all);
    return {{"open-enclosure", rim(search, escapes.all, middle),
             share_text(share) + " of the light escapes at each reflection, through a hole near " +
                 place_text(middle, search.size_at(middle)) + " in a room that is closed otherwise",
             "put in the wall that is missing, or a polygon for the window or sky that is meant",
             1}};
}

}  // namespace patchlight
