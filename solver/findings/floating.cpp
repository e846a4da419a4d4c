#include "solver/findings/floating.h"

#include "solver/findings/walkers.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"
#include "solver/scene/touching_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace patchlight {

namespace {

constexpr double near = 0.01;         // of the body's size: nearer looks as if it touched [1]
constexpr double largest = 0.5;       // of the size of what is around, that a body is [1]
constexpr double thinnest = 0.02;     // of a body's size: thinner is a sheet [1]
constexpr std::size_t views = 32;     // along a gap
constexpr double thickest_gap = 0.1;  // of the body's thickness [1]

Box box_of(const SurfaceTree& tree, const std::vector<SurfaceIndex>& surfaces) {
    Box box;
    for (const SurfaceIndex s : surfaces) box.extend(tree.box(s));
    return box;
}

/// Corners and middles: where one body may be nearest to another.
std::vector<Vec3> feelers(const Surface& surface) {
    std::vector<Vec3> points = surface.corners;
    Vec3 middle = Vec3::Zero();
    const std::size_t n = surface.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        points.push_back(0.5 * (surface.corners[k] + surface.corners[(k + 1) % n]));
        middle += surface.corners[k] / static_cast<double>(n);
    }
    points.push_back(middle);
    return points;
}

/// Extent of a body along a direction [m].
double thickness(const Scene& scene, const std::vector<SurfaceIndex>& surfaces, const Vec3& along) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const SurfaceIndex s : surfaces)
        for (const Vec3& p : scene.surfaces[s].corners) {
            low = std::min(low, p.dot(along));
            high = std::max(high, p.dot(along));
        }
    return high - low;
}

/// Whether light that is sent on by surface s can come to p.
bool is_before(const Scene& scene, SurfaceIndex s, const Vec3& p) {
    const Surface& surface = scene.surfaces[s];
    return scene.materials[surface.material].two_sided ||
           (p - surface.corners[0]).dot(surface.normal) > 0.0;
}

/// Whether at least a quarter of what is seen from the gap, along it, is no back.
bool is_reached_by_light(const FlawSearch& search, const Floating& one) {
    const Vec3& up = search.scene.surfaces[one.support].normal;
    const PlaneFrame around = frame_of(one.place - 0.5 * one.distance * up, up);
    std::vector<Walker> walkers(views);
    for (std::size_t k = 0; k < views; ++k) {
        const double angle = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / views;
        walkers[k].frame = search.rays.frame(one.support);
        walkers[k].origin = search.rays.to_ray_space(around.origin, walkers[k].frame);
        walkers[k].direction =
            (std::cos(angle) * around.u + std::sin(angle) * around.v).cast<float>();
    }
    fly(search.rays, walkers);
    return std::count_if(walkers.begin(), walkers.end(), [](const Walker& walker) {
               return walker.landing != Landing::back;
           }) >= static_cast<std::ptrdiff_t>(views / 4);
}

std::optional<Floating> nearest_support(const FlawSearch& search, const Assemblies& assemblies,
                                        const SurfaceTree& tree, std::uint32_t number) {
    const std::vector<SurfaceIndex>& body = assemblies.members[number];
    const Box box = box_of(tree, body);
    const double size = box.diagonal().norm();
    if (size > largest * search.size(body[0])) return std::nullopt;
    std::optional<Floating> nearest;
    double reach = near * size;
    const Vec3 margin = Vec3::Constant(reach);
    std::vector<SurfaceIndex> others = tree.over(Box(box.min() - margin, box.max() + margin));
    std::erase_if(others, [&](SurfaceIndex s) { return assemblies.of_surface[s] == number; });
    if (others.empty()) return std::nullopt;
    const SurfaceTree others_tree = tree.only(others);
    for (const SurfaceIndex s : body)
        for (const Vec3& p : feelers(search.scene.surfaces[s]))
            for (const SurfaceTree::Near& other : others_tree.within(p, reach)) {
                if (nearest && other.distance >= nearest->distance) continue;
                if (!is_before(search.scene, other.surface, p)) continue;
                nearest = Floating{s, other.surface, number, p, other.distance};
                reach = other.distance;
            }
    if (!nearest) return std::nullopt;
    const Vec3& up = search.scene.surfaces[nearest->support].normal;
    const double thick = thickness(search.scene, body, up);
    const bool is_body = thick > thinnest * size && nearest->distance < thickest_gap * thick;
    return is_body && is_reached_by_light(search, *nearest) ? nearest : std::nullopt;
}

}  // namespace

std::vector<Floating> find_floating(const FlawSearch& search, const Assemblies& assemblies,
                                    const SurfaceTree& tree) {
    const std::size_t count = assemblies.members.size();
    std::vector<std::optional<Floating>> found(count);
    for_each_in_parallel(count, search.go_on, [&](std::size_t number) {
        found[number] =
            nearest_support(search, assemblies, tree, static_cast<std::uint32_t>(number));
    });
    std::vector<Floating> floating;
    for (const auto& one : found)
        if (one) floating.push_back(*one);
    return floating;
}

std::vector<Finding> floating_findings(const FlawSearch& search,
                                       const std::vector<Floating>& floating) {
    std::map<std::pair<std::string, std::string>, std::size_t> number_of;
    std::vector<Finding> findings;
    for (const Floating& one : floating) {
        const std::string &body = search.object_of(one.body),
                          &support = search.object_of(one.support);
        const auto [known, is_new] = number_of.emplace(std::pair(body, support), findings.size());
        if (!is_new) {
            ++findings[known->second].count;
            continue;
        }
        findings.push_back(
            {"floating-object",
             {body},
             "a part of " + quoted(body) + " that touches nothing is " + length_text(one.distance) +
                 " off " + (body == support ? "the rest of it" : quoted(support)) + " at " +
                 place_text(one.place, search.size(one.body)) + ": light gets underneath",
             "move it until it touches, or farther away",
             1});
        if (body != support) findings.back().objects.push_back(support);
    }
    return findings;
}

}  // namespace patchlight
