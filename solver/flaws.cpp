#include "solver/flaws.h"

#include "solver/solve_scene.h"

#include <algorithm>

namespace patchlight {

std::vector<Finding> find_geometry_flaws(const Scene& scene, const CoplanarOverlaps& overlaps) {
    std::vector<Finding> findings = scene.findings;
    for (Finding& finding : overlap_findings(scene, overlaps))
        findings.push_back(std::move(finding));
    return findings;
}

std::vector<Finding> find_flaws(const Scene& scene, const CoplanarOverlaps& overlaps) {
    std::vector<Finding> findings = find_geometry_flaws(scene, overlaps);
    const bool lit = std::any_of(
        scene.surfaces.begin(), scene.surfaces.end(),
        [&](const Surface& s) { return (scene.materials[s.material].exitance > 0.0).any(); });
    if (!lit)
        findings.push_back({"no-emitter",
                            {},
                            "nothing in the scene gives off light, so all of it is black",
                            "give a material `exitance` or `radiance`",
                            1});
    return findings;
}

std::vector<Finding> find_flaws(const Scene& scene) {
    return find_flaws(scene, find_coplanar_overlaps(scene));
}

}  // namespace patchlight
