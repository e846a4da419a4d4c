#include "solver/flaws.h"

#include "solver/findings/assemblies.h"
#include "solver/findings/cracks.h"
#include "solver/findings/flipped.h"
#include "solver/findings/floating.h"
#include "solver/findings/gaps.h"
#include "solver/findings/leaks.h"
#include "solver/findings/merge.h"
#include "solver/findings/misplaced.h"
#include "solver/findings/openings.h"
#include "solver/findings/overlaps.h"
#include "solver/findings/singularity.h"
#include "solver/findings/slivers.h"
#include "solver/findings/small_emitters.h"
#include "solver/findings/wasted_light.h"
#include "solver/solve_plan.h"
#include "solver/solve_scene.h"

#include <algorithm>
#include <iterator>

namespace patchlight {

namespace {

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
    std::move(more.begin(), more.end(), std::back_inserter(findings));
}

bool is_told_of(const std::vector<Finding>& findings, const char* kind) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.kind == kind; });
}

std::vector<Finding> emitter_findings(const Scene& scene) {
    const bool lit = std::any_of(
        scene.surfaces.begin(), scene.surfaces.end(),
        [&](const Surface& s) { return (scene.materials[s.material].exitance > 0.0).any(); });
    if (lit) return {};
    return {{"no-emitter",
             {},
             "nothing in the scene gives off light, so all of it is black",
             "give a material `exitance` or `radiance`",
             1}};
}

/// A gap between a body and what it hangs off is one or the other: a leak where the room that is
/// lit is the body itself, else the body floats.
void settle(const Assemblies& assemblies, std::vector<Leak>& leaks,
            std::vector<Floating>& floating) {
    const auto between = [&](const Leak& leak, const Floating& one) {
        const std::uint32_t a = assemblies.of_surface[leak.gap.owner],
                            b = assemblies.of_surface[leak.gap.other];
        return a != b && (a == one.assembly || b == one.assembly);
    };
    std::erase_if(floating, [&](const Floating& one) {
        return std::any_of(leaks.begin(), leaks.end(), [&](const Leak& leak) {
            return between(leak, one) && assemblies.of_surface[leak.lit] == one.assembly;
        });
    });
    std::erase_if(leaks, [&](const Leak& leak) {
        return std::any_of(floating.begin(), floating.end(),
                           [&](const Floating& one) { return between(leak, one); });
    });
}

std::vector<Slit> slits_of(const SurfaceEdges& edges, const std::vector<Leak>& leaks,
                           const std::vector<Crack>& cracks) {
    std::vector<Slit> slits;
    const auto add = [&](std::size_t edge, double width) {
        const auto& ends = edges.edges[edge].ends;
        slits.push_back({edges.vertices[ends[0]], edges.vertices[ends[1]], width});
    };
    for (const Leak& leak : leaks) add(leak.gap.edge, leak.gap.width);
    for (const Crack& crack : cracks) add(crack.edge, crack.width);
    return slits;
}

std::vector<Finding> shape_findings(const FlawSearch& search) {
    std::vector<Finding> findings;
    if (search.stopped()) return findings;
    const SurfaceTree tree(search.scene);
    const SurfaceEdges edges = find_surface_edges(search.scene);
    const std::vector<Crack> cracks = find_cracks(search, edges);
    if (search.stopped()) return findings;
    const Assemblies assemblies = find_assemblies(search, tree);
    if (search.stopped()) return findings;
    std::vector<Leak> leaks = find_leaks(search, find_gaps(search, edges, tree, cracks));
    if (search.stopped()) return findings;
    std::vector<Floating> floating = find_floating(search, assemblies, tree);
    const std::vector<Finding> openings = find_openings(search, slits_of(edges, leaks, cracks));
    settle(assemblies, leaks, floating);
    findings = leak_findings(search, leaks);
    append(findings, openings);
    if (!search.stopped()) append(findings, find_flipped(search));
    append(findings, floating_findings(search, floating));
    append(findings, crack_findings(search, edges, cracks));
    append(findings, find_slivers(search));
    return findings;
}

}  // namespace

std::vector<Finding> find_geometry_flaws(const Scene& scene, const CoplanarOverlaps& overlaps,
                                         const RayScene& rays, std::uint64_t seed,
                                         const std::function<bool()>& go_on) {
    std::vector<Finding> findings = scene.findings;
    append(findings, overlap_findings(scene, overlaps));
    append(findings, shape_findings(FlawSearch{scene, overlaps, rays, seed, go_on}));
    return merge_alike(std::move(findings));
}

Flaws find_flaws(const Scene& scene, const CoplanarOverlaps& overlaps, const RayScene& rays,
                 const SolveSettings& planned, std::span<const Viewpoint> viewpoints,
                 const std::function<bool()>& go_on) {
    const FlawSearch search{scene, overlaps, rays, planned.seed, go_on};
    Misplaced misplaced = find_misplaced(search, viewpoints);
    Flaws flaws{find_geometry_flaws(scene, overlaps, rays, planned.seed, go_on),
                std::move(misplaced.sensors)};
    append(flaws.findings, emitter_findings(scene));
    if (!search.stopped()) {
        append(flaws.findings,
               find_wasted_light(search, is_told_of(flaws.findings, "flipped-normals")));
        append(flaws.findings, find_small_emitters(search, planned));
        append(flaws.findings, find_singularity(search));
    }
    append(flaws.findings, std::move(misplaced.findings));
    return flaws;
}

std::vector<Finding> find_flaws(const Scene& scene, const SolveSettings& settings,
                                std::span<const Viewpoint> viewpoints) {
    if (scene.surfaces.empty()) return scene.findings;
    const CoplanarOverlaps overlaps = find_coplanar_overlaps(scene);
    return find_flaws(scene, overlaps, RayScene(scene, overlaps),
                      plan_solve(scene, settings).settings, viewpoints)
        .findings;
}

}  // namespace patchlight
