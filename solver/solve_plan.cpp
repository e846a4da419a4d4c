#include "solver/solve_plan.h"

#include "solver/hierarchy/light_clusters.h"
#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"
#include "solver/transport/row_source.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

namespace patchlight {

namespace {

constexpr double default_accuracy = 0.02;
constexpr int default_analytic_rays = 1024;
constexpr int coarse_rays = 256;  // where the display is gathered anew
constexpr int cluster_rays = 256;
constexpr double fewest_coarse_patches = 40.0, most_coarse_patches = 300.0;
constexpr double coarse_patch_share = 3.0;  // of a coarse solution's patches, over the accuracy
constexpr std::size_t most_matrix_patches = 4000;  // of a coarse solution: more take too long
constexpr int default_cast_rays = 4096;
constexpr double default_tolerance = 1e-4;
constexpr double sweep_share = 0.02, shot_share = 0.4;  // of the accuracy, for the algebraic bound
constexpr double hand_set_patches = 2000.0;
constexpr int default_iterations = 1000;
constexpr int default_shots = 10'000'000;
constexpr int default_hemicube_resolution = 128;
constexpr double share_of_machine = 0.8;  // of its memory that a solve may take unasked

/// Hand-set settings that no solver takes yet.
void refuse_unbuilt(const SolveSettings& settings) {
    if (settings.method == Method::hierarchical && !settings.accuracy)
        throw InputError("/solve/solver",
                         "\"hierarchical\" solves to an accuracy; give `accuracy`, or use "
                         "\"gauss-seidel\" or \"shooting\"");
    if (settings.method == Method::hierarchical && settings.engine != Engine::automatic &&
        settings.engine != Engine::ray_cast)
        throw InputError("/solve/form_factors",
                         "\"hierarchical\" casts rays; use \"ray-cast\" or \"auto\"");
}

/// Whether a setting is given that stands in place of an accuracy.
bool is_set_by_hand(const SolveSettings& settings) {
    return settings.patch_size || settings.rays || settings.hemicube_resolution ||
           settings.tolerance || settings.max_iterations;
}

/// Settings that the chosen method or engine has no use for.
void refuse_idle(const SolveSettings& settings) {
    if (settings.ambient.value_or(false) && settings.method != Method::shooting &&
        settings.method != Method::automatic)
        throw InputError("/solve/ambient", "belongs to the solver \"shooting\"");
    if (settings.hemicube_resolution && settings.engine != Engine::hemicube &&
        (settings.engine != Engine::automatic || settings.rays))
        throw InputError("/solve/hemicube_resolution", "belongs to the form factors \"hemicube\"");
    if (settings.rays && settings.engine == Engine::hemicube)
        throw InputError("/solve/rays",
                         "the form factors \"hemicube\" cast no rays; give `hemicube_resolution`");
}

std::string engine_reason(const SolveSettings& asked, Engine chosen) {
    switch (asked.engine) {
        case Engine::automatic:
            if (asked.method == Method::hierarchical)
                return "Ray-cast form factors, as clusters of patches need";
            if (chosen == Engine::hemicube)
                return "Hemicube form factors, for their resolution is given";
            if (chosen == Engine::ray_cast)
                return "Ray-cast form factors, for the matrix of so many patches would take too "
                       "long or not fit in memory";
            return "Analytic form factors, for they are exact where nothing blocks and rays are "
                   "cast only where something may";
        case Engine::analytic:
            return "Analytic form factors as asked";
        case Engine::ray_cast:
            return "Ray-cast form factors as asked";
        case Engine::hemicube:
            return "Hemicube form factors as asked";
    }
    throw std::logic_error("engine without a case");
}

std::string method_reason(const Scene& scene, Method method) {
    const std::string channels =
        is_grey(scene) ? "; one channel, for the scene is grey; " : "; three channels at once; ";
    switch (method) {
        case Method::shooting:
            return channels + "shooting with rows on demand, the brightest patch first.";
        case Method::hierarchical:
            return channels +
                   "patches that lie together and face alike carry light as one: "
                   "Gauss–Seidel on the matrix of such clusters.";
        case Method::gauss_seidel:
            return channels + "Gauss–Seidel on the stored matrix.";
        case Method::automatic:
            break;
    }
    throw std::logic_error("method without a case");
}

std::uint64_t machine_memory() {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || page <= 0) return std::uint64_t{8} << 30;
    return static_cast<std::uint64_t>(share_of_machine * static_cast<double>(pages) *
                                      static_cast<double>(page));
}

/// What is left to choose of engine and method. Rays take over where a matrix of all patches would
/// not fit or take too long: between clusters of patches, or where patches are set by hand shot,
/// for their rows cost no more where there are more patches.
void choose_method(const Scene& scene, SolveSettings& s) {
    const bool is_free = s.engine == Engine::automatic && s.method == Method::automatic &&
                         !s.hemicube_resolution && !s.ambient;
    if (s.engine == Engine::automatic)
        s.engine = s.hemicube_resolution              ? Engine::hemicube
                   : s.method == Method::hierarchical ? Engine::ray_cast
                                                      : Engine::analytic;
    if (s.method == Method::automatic)
        s.method = s.ambient.value_or(false) ? Method::shooting : Method::gauss_seidel;
    if (!is_free) return;
    const std::size_t patches = estimate_patch_count(scene, *s.patch_size);
    const bool quick = !s.accuracy || patches <= most_matrix_patches;
    if (quick && estimate_memory(scene, patches, s) <= *s.memory_limit) return;
    s.engine = Engine::ray_cast;
    s.method = s.accuracy ? Method::hierarchical : Method::shooting;
}

/// A coarse solution need not be finer than what is gathered from it.
double coarse_patches_for(double accuracy) {
    return std::clamp(coarse_patch_share / accuracy, fewest_coarse_patches, most_coarse_patches);
}

/// Patches, or clusters of them, between which light goes.
double carriers_of(std::size_t patches, const SolveSettings& planned) {
    return static_cast<double>(
        planned.method == Method::hierarchical ? std::min(patches, most_clusters) : patches);
}

}  // namespace

SolvePlan plan_solve(const Scene& scene, const SolveSettings& settings) {
    refuse_idle(settings);
    SolvePlan plan{settings, ""};
    SolveSettings& s = plan.settings;
    if (!s.accuracy && !is_set_by_hand(s)) s.accuracy = default_accuracy;
    refuse_unbuilt(s);
    if (!s.patch_size)
        s.patch_size =
            patch_size_for(scene, s.accuracy ? coarse_patches_for(*s.accuracy) : hand_set_patches);
    if (!s.memory_limit) s.memory_limit = machine_memory();
    choose_method(scene, s);
    const bool shoots = s.method == Method::shooting;
    if (!s.rays && s.engine != Engine::hemicube)
        s.rays = s.method == Method::hierarchical ? cluster_rays
                 : s.accuracy                     ? coarse_rays
                 : s.engine == Engine::analytic   ? default_analytic_rays
                                                  : default_cast_rays;
    if (!s.hemicube_resolution && s.engine == Engine::hemicube)
        s.hemicube_resolution = default_hemicube_resolution;
    if (!s.tolerance)
        s.tolerance =
            s.accuracy ? (shoots ? shot_share : sweep_share) * *s.accuracy : default_tolerance;
    if (!s.max_iterations) s.max_iterations = shoots ? default_shots : default_iterations;
    if (!s.ambient && shoots) s.ambient = true;
    if (s.threads <= 0)
        s.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    plan.why = engine_reason(settings, s.engine) + method_reason(scene, s.method);
    if (s.accuracy)
        plan.why +=
            " That solution is coarse: what is shown is gathered from it, and refined until the "
            "error measured at random points is within the accuracy.";
    return plan;
}

std::uint64_t estimate_memory(const Scene& scene, std::size_t patches,
                              const SolveSettings& planned) {
    const double n = static_cast<double>(patches);
    const bool counted = planned.engine != Engine::analytic;  // full rows, then joined
    // Entries of a row: all patches but one's own plane, or as many as there are samples.
    const double samples = planned.engine == Engine::ray_cast ? *planned.rays
                           : planned.engine == Engine::hemicube
                               ? 3.0 * *planned.hemicube_resolution * *planned.hemicube_resolution
                               : n;
    const double carriers = carriers_of(patches, planned);
    const double row = std::min(carriers, samples);
    const double geometry = 2000.0 * n + 400.0 * static_cast<double>(scene.surfaces.size());
    double bytes = 3e7 + geometry;
    if (planned.method == Method::shooting) {
        bytes += std::min(static_cast<double>(kept_row_bytes), 8.0 * n * row) + 300.0 * row;
    } else {
        const double joined = 16.0 * carriers * row / (counted ? 1.0 : 2.0);
        const double joining = counted ? 12.0 * carriers * row : 0.0;
        const double matrix = std::min(4.0 * carriers * carriers, 8.0 * carriers * row);
        bytes += joined + std::max(joining, matrix);
    }
    return bytes < 1.8e19 ? static_cast<std::uint64_t>(bytes)
                          : std::numeric_limits<std::uint64_t>::max();
}

void check_memory(const Scene& scene, std::size_t patches, const SolveSettings& planned) {
    const std::uint64_t needed = estimate_memory(scene, patches, planned);
    if (needed <= *planned.memory_limit) return;
    constexpr std::uint64_t beyond_any = std::uint64_t{1} << 60;  // no machine has an exbibyte
    throw InputError("/solve/patch_size",
                     "about " + std::to_string(patches) + " patches would need " +
                         (needed < beyond_any ? "about " + std::to_string(needed) + " bytes"
                                              : "more bytes than any machine has") +
                         "; the memory limit is " + std::to_string(*planned.memory_limit) +
                         " bytes: give a larger patch_size, or a higher memory_limit");
}

namespace {

/// Exactly where that is quick, else about.
std::size_t count_patches(const Scene& scene, const SolveSettings& planned) {
    constexpr std::size_t quick = 50'000;  // patches that are made in a few hundredths of a second
    const bool cut_slivers = planned.method != Method::hierarchical;
    const std::size_t estimate = estimate_patch_count(scene, *planned.patch_size, cut_slivers);
    if (estimate > quick) return estimate;
    MeshLines lines = find_mesh_lines(scene);
    lines.cut_slivers = cut_slivers;
    return make_patches(scene, lines, *planned.patch_size).size();
}

}  // namespace

CostEstimate estimate_cost(const Scene& scene, const SolveSettings& settings) {
    const SolvePlan plan = plan_solve(scene, settings);
    CostEstimate cost;
    cost.patches = count_patches(scene, plan.settings);
    cost.memory_limit = *plan.settings.memory_limit;
    cost.memory = estimate_memory(scene, cost.patches, plan.settings);
    const double n = static_cast<double>(cost.patches);
    constexpr double seconds_per_pair = 2.5e-7, seconds_per_ray = 1.2e-7, seconds_per_entry = 3e-8;
    constexpr double seconds_per_cell = 1.2e-7;  // sub-samples included
    const SolveSettings& s = plan.settings;
    const double carriers = carriers_of(cost.patches, s);
    const double rows =
        s.engine == Engine::analytic ? seconds_per_pair * n * n / 2.0
        : s.engine == Engine::ray_cast
            ? seconds_per_ray * carriers * *s.rays
            : seconds_per_cell * n * 3.0 * *s.hemicube_resolution * *s.hemicube_resolution;
    constexpr double shots_per_patch = 4.0;  // to the default tolerance, where most is white
    const double times = s.method == Method::shooting ? shots_per_patch : 1.0;
    cost.seconds = (times * rows + seconds_per_entry * carriers * carriers) / s.threads;
    if (s.accuracy) {  // gathering: measured on the Cornell box and rooms with boxes
        constexpr double seconds_per_patch = 1e-3, power = 1.4, measured_at = 0.01;
        cost.seconds +=
            seconds_per_patch * n * std::pow(measured_at / *s.accuracy, power) / s.threads;
    }
    return cost;
}

}  // namespace patchlight
