#include "solver/accuracy/carried_residual.h"
#include "solver/accuracy/check_points.h"
#include "solver/accuracy/judge.h"
#include "solver/display/vertex_irradiance.h"
#include "solver/solve_stage.h"
#include "solver/transport/patch_fields.h"

namespace patchlight {

namespace {

constexpr std::size_t most_sources = 256;
constexpr int most_samples = 4096;

/// Irradiance straight from sources at the middle of each patch.
std::vector<Rgb> once_arriving(const PatchMesh& mesh, const VertexGather& gather,
                               std::uint64_t seed) {
    std::vector<Rgb> once(mesh.size(), Rgb::Zero());
    for (PatchIndex i = 0; i < mesh.size(); ++i)
        if (!mesh.patches[i].covered)
            once[i] = gather.gather()
                          .direct(gather.point(i, mesh.patches[i].centre), {16, 64}, mix(seed, i))
                          .irradiance;
    return once;
}

}  // namespace

void check_solution(const SolveStage& stage, const MeshLines& lines) {
    Solution& solution = stage.solution;
    const Scene& scene = stage.scene;
    const std::uint64_t seed = mix(solution.settings.seed, 0x636865636b);
    const auto go_on = [&] {
        return stage.watch.step({Stage::display, 1.0}) == StopReason::tolerance;
    };
    const PointGather gather(stage.rays, find_light_sources(scene, lines, stage.rays, most_sources),
                             most_samples);
    const VertexGather points(scene, solution.mesh, stage.rays, find_plane_groups(scene), gather,
                              seed, go_on);
    const PatchLocator locator(scene, solution.mesh, stage.rays);
    // What rays read: all that is displayed but the sources that are gathered from one by one.
    std::vector<bool> listed(scene.surfaces.size(), false);
    for (const LightSource& source : gather.sources()) listed[source.surface] = true;
    const std::vector<Rgb> exitance = exitances(scene, solution.mesh);
    std::vector<Rgb> without(solution.mesh.size(), Rgb::Zero());
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
        if (listed[points.surface_of(i)]) without[i] = exitance[i];
    const ReflectedField field(scene, solution.mesh, stage.rays, locator,
                               FieldTable(solution.mesh, solution.display, stage.rays,
                                          solution.display.radiosity, without));
    TreeDisplay shown{solution.display, {{}, vertex_irradiance(scene, solution)}};
    std::vector<Rgb> reflected = solution.radiosity;
    for (std::size_t i = 0; i < reflected.size(); ++i) reflected[i] -= exitance[i];
    const ReflectedLight light = measure_reflected(scene, solution.mesh, reflected,
                                                   once_arriving(solution.mesh, points, seed));
    if (!(light.norm > 0.0)) return;  // nothing is sent back, so nothing can be wrong
    const CheckReport checks = check_display(scene, shown, points, field, CheckEffort{}, seed);
    Evidence evidence;
    evidence.algebraic_bound = solution.error.algebraic_bound;
    evidence.checks = &checks;
    evidence.light = light;
    evidence.energy = solution.energy;
    evidence.carried =
        carried_residual(scene, stage.rays, checks, solution.energy, mix(seed, 0x63617272));
    solution.error = judge(evidence);
}

}  // namespace patchlight
