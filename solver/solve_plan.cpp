#include "solver/solve_plan.h"

#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace patchlight {

namespace {

constexpr int default_analytic_rays = 1024;
constexpr int default_cast_rays = 4096;
constexpr double default_tolerance = 1e-4;
constexpr int default_iterations = 1000;
constexpr double share_of_machine = 0.8;  // of its memory that a solve may take unasked

void refuse_unbuilt(const SolveSettings& settings) {
    if (settings.method == Method::shooting || settings.method == Method::hierarchical)
        throw InputError("/solve/solver", "this solver is not built yet; use \"gauss-seidel\"");
    if (settings.engine == Engine::hemicube)
        throw InputError("/solve/form_factors",
                         "`hemicube` is not built yet; use \"analytic\" or \"ray-cast\"");
    if (settings.accuracy)
        throw InputError(
            "/solve/accuracy",
            "solving to an accuracy is not built yet; give `patch_size`, `rays` and `tolerance`");
    if (settings.ambient)
        throw InputError("/solve/ambient",
                         "belongs to the solver `shooting`, which is not built yet");
    if (settings.hemicube_resolution)
        throw InputError("/solve/hemicube_resolution",
                         "belongs to the engine `hemicube`, which is not built yet");
}

std::uint64_t machine_memory() {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || page <= 0) return std::uint64_t{8} << 30;
    return static_cast<std::uint64_t>(share_of_machine * static_cast<double>(pages) *
                                      static_cast<double>(page));
}

}  // namespace

SolvePlan plan_solve(const Scene& scene, const SolveSettings& settings) {
    refuse_unbuilt(settings);
    SolvePlan plan{settings, ""};
    SolveSettings& s = plan.settings;
    const bool chosen = s.engine == Engine::automatic;
    if (chosen) s.engine = Engine::analytic;
    s.method = Method::gauss_seidel;
    if (!s.patch_size) s.patch_size = default_patch_size(scene);
    if (!s.rays) s.rays = s.engine == Engine::analytic ? default_analytic_rays : default_cast_rays;
    if (!s.tolerance) s.tolerance = default_tolerance;
    if (!s.max_iterations) s.max_iterations = default_iterations;
    if (!s.memory_limit) s.memory_limit = machine_memory();
    if (s.threads <= 0)
        s.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    plan.why = chosen ? "Analytic form factors, for they are exact where nothing blocks and rays "
                        "are cast only where something may"
               : s.engine == Engine::analytic ? "Analytic form factors as asked"
                                              : "Ray-cast form factors as asked";
    plan.why += is_grey(scene)
                    ? "; one channel, for the scene is grey; Gauss–Seidel on the stored matrix."
                    : "; three channels in one sweep of Gauss–Seidel over the stored matrix.";
    return plan;
}

std::uint64_t estimate_memory(const Scene& scene, std::size_t patches,
                              const SolveSettings& planned) {
    const double n = static_cast<double>(patches);
    // Entries of a row: all patches but one's own plane, or as many as there are rays to hit them.
    const double row =
        planned.engine == Engine::ray_cast ? std::min(n, static_cast<double>(*planned.rays)) : n;
    const double joined = 16.0 * n * row / (planned.engine == Engine::ray_cast ? 1.0 : 2.0);
    const double joining = planned.engine == Engine::ray_cast ? 12.0 * n * row : 0.0;
    const double matrix = std::min(4.0 * n * n, 8.0 * n * row);
    const double geometry = 2000.0 * n + 400.0 * static_cast<double>(scene.surfaces.size());
    const double bytes = 3e7 + geometry + joined + std::max(joining, matrix);
    return bytes < 1.8e19 ? static_cast<std::uint64_t>(bytes)
                          : std::numeric_limits<std::uint64_t>::max();
}

void check_memory(const Scene& scene, std::size_t patches, const SolveSettings& planned) {
    const std::uint64_t needed = estimate_memory(scene, patches, planned);
    if (needed <= *planned.memory_limit) return;
    throw InputError("/solve/patch_size",
                     "about " + std::to_string(patches) + " patches would need about " +
                         std::to_string(needed) + " bytes; the memory limit is " +
                         std::to_string(*planned.memory_limit) +
                         " bytes: give a larger patch_size, or a higher memory_limit");
}

CostEstimate estimate_cost(const Scene& scene, const SolveSettings& settings) {
    const SolvePlan plan = plan_solve(scene, settings);
    CostEstimate cost;
    cost.patches = estimate_patch_count(scene, *plan.settings.patch_size);
    cost.memory = estimate_memory(scene, cost.patches, plan.settings);
    const double n = static_cast<double>(cost.patches);
    constexpr double seconds_per_pair = 2.5e-7, seconds_per_ray = 1.2e-7, seconds_per_entry = 3e-8;
    const double rows = plan.settings.engine == Engine::analytic
                            ? seconds_per_pair * n * n / 2.0
                            : seconds_per_ray * n * *plan.settings.rays;
    cost.seconds = (rows + seconds_per_entry * n * n) / plan.settings.threads;
    return cost;
}

bool is_grey(const Scene& scene) {
    return std::all_of(
        scene.materials.begin(), scene.materials.end(), [](const Material& material) {
            const auto grey = [](const Rgb& x) { return x[0] == x[1] && x[1] == x[2]; };
            return grey(material.reflectance) && grey(material.exitance);
        });
}

}  // namespace patchlight
