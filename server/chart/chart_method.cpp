#include "server/chart/chart_method.h"

#include "server/wording.h"
#include "solver/mesh/make_patches.h"

#include <stdexcept>

namespace patchlight::server {
namespace {

constexpr std::array accuracies{0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.003};
constexpr std::array mesh_sizes{125.0, 500.0, 2000.0, 8000.0};  // patches, about
constexpr double much_finer = 1.5;  // patches over those of the mesh before
constexpr std::array ray_counts{256, 1024, 4096};
constexpr std::array resolutions{64, 128, 256};

/// Fine efforts are wasted on the coarsest mesh, coarse ones on the finest.
bool is_sensible(std::size_t mesh, std::size_t effort) {
    if (mesh == 0) return effort <= 1;
    if (mesh + 1 == mesh_sizes.size()) return effort >= 1;
    return true;
}

void set_effort(SolveSettings& settings, std::size_t effort) {
    switch (settings.engine) {
        case Engine::analytic:
        case Engine::ray_cast:
            settings.rays = ray_counts[effort];
            return;
        case Engine::hemicube:
            settings.hemicube_resolution = resolutions[effort];
            return;
        case Engine::automatic:
            break;
    }
    throw std::logic_error("an engine without an effort");
}

/// Longest edges of patches, each mesh much finer than the one before [m].
std::vector<double> patch_sizes(const Scene& scene) {
    std::vector<double> sizes;
    double coarser = 0.0;
    for (const double wanted : mesh_sizes) {
        const double size = patch_size_for(scene, wanted);
        const auto patches = static_cast<double>(estimate_patch_count(scene, size));
        if (patches < much_finer * coarser) continue;
        coarser = patches;
        sizes.push_back(size);
    }
    return sizes;
}

}  // namespace

std::string setting_text(const ChartMethod& method) {
    const SolveSettings& settings = method.settings;
    if (settings.accuracy) return "accuracy " + number_text(*settings.accuracy);
    std::string text = std::to_string(method.cost.patches) + " patches, ";
    if (settings.rays) return text + std::to_string(*settings.rays) + " rays";
    return text + "hemicube " + std::to_string(settings.hemicube_resolution.value_or(0));
}

std::vector<ChartMethod> chart_methods(const Scene& scene, const SolveSettings& base) {
    SolveSettings plain;
    plain.seed = base.seed;
    plain.memory_limit = base.memory_limit;
    std::vector<ChartMethod> methods;
    const auto add = [&](SeriesIndex series, const SolveSettings& settings) {
        methods.push_back({series, settings, estimate_cost(scene, settings)});
    };
    for (const double accuracy : accuracies) {
        SolveSettings settings = plain;
        settings.accuracy = accuracy;
        add(automatic_series, settings);
    }
    const std::vector<double> sizes = patch_sizes(scene);
    for (SeriesIndex series = automatic_series + 1; series < all_series.size(); ++series)
        for (std::size_t mesh = 0; mesh < sizes.size(); ++mesh)
            for (std::size_t effort = 0; effort < ray_counts.size(); ++effort) {
                if (!is_sensible(mesh, effort)) continue;
                SolveSettings settings = plain;
                settings.method = all_series[series].method;
                settings.engine = all_series[series].engine;
                settings.patch_size = sizes[mesh];
                set_effort(settings, effort);
                add(series, settings);
            }
    return methods;
}

}  // namespace patchlight::server
