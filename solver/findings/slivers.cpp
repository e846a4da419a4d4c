#include "solver/findings/slivers.h"

#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"

#include <map>

namespace patchlight {

namespace {

constexpr double slenderest = 500.0;  // length over mean width, unsaid [1]

/// Longest distance of two corners [m]; of those of many corners, a side of the box round them.
double longest_extent(const Surface& surface) {
    constexpr std::size_t few = 64;
    const std::vector<Vec3>& corners = surface.corners;
    double longest = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        for (std::size_t l = corners.size() > few ? corners.size() : 0; l < k; ++l)
            longest = std::max(longest, (corners[k] - corners[l]).norm());
    if (corners.size() <= few) return longest;
    Vec3 low = corners[0], high = corners[0];
    for (const Vec3& p : corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return (high - low).maxCoeff();
}

struct Slenderest {
    double aspect = 0.0;  // [1]
    SurfaceIndex surface = 0;
    std::size_t count = 0;
};

}  // namespace

std::vector<Finding> find_slivers(const FlawSearch& search) {
    std::map<ObjectIndex, Slenderest> slivers;
    for (SurfaceIndex s = 0; s < search.scene.surfaces.size(); ++s) {
        const Surface& surface = search.scene.surfaces[s];
        if (surface.side == Side::back) continue;
        const double length = longest_extent(surface), aspect = length * length / surface.area;
        if (aspect <= slenderest) continue;
        Slenderest& most = slivers[surface.object];
        ++most.count;
        if (aspect > most.aspect) most.aspect = aspect, most.surface = s;
    }
    std::vector<Finding> findings;
    for (const auto& [object, most] : slivers) {
        const Surface& surface = search.scene.surfaces[most.surface];
        const std::string& name = search.scene.objects[object].name;
        findings.push_back(
            {"sliver",
             {name},
             "a polygon of " + quoted(name) + " near " +
                 place_text(centroid(surface.corners, surface.normal), search.size(most.surface)) +
                 " is " + number_text(most.aspect) +
                 " times as long as it is wide: it costs many patches for little area",
             "merge it with its neighbours, or leave it out",
             most.count});
    }
    return findings;
}

}  // namespace patchlight
