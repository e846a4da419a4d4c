#pragma once

#include "solver/solve_scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace patchlight::server {

/// What becomes one line of a chart: a solver on form factors of one kind, or what is chosen by
/// itself to an accuracy.
struct Series {
    const char* name;
    Method method;
    Engine engine;
};

inline constexpr std::array all_series{
    Series{"auto", Method::automatic, Engine::automatic},
    Series{"gauss-seidel, analytic", Method::gauss_seidel, Engine::analytic},
    Series{"gauss-seidel, ray-cast", Method::gauss_seidel, Engine::ray_cast},
    Series{"gauss-seidel, hemicube", Method::gauss_seidel, Engine::hemicube},
    Series{"shooting, analytic", Method::shooting, Engine::analytic},
    Series{"shooting, ray-cast", Method::shooting, Engine::ray_cast},
    Series{"shooting, hemicube", Method::shooting, Engine::hemicube},
};
using SeriesIndex = std::uint32_t;
inline constexpr SeriesIndex automatic_series = 0;

/// One way to solve a scene that is charted.
struct ChartMethod {
    SeriesIndex series = automatic_series;
    SolveSettings settings;
    CostEstimate cost;
};

/// How it was set, such as "accuracy 0.01" or "2040 patches, 1024 rays".
std::string setting_text(const ChartMethod& method);

/// Every way: solver × form factors × mesh × effort, as many rays or as fine hemicubes as the mesh
/// deserves, and solves to seven accuracies. `base` gives seed and memory limit. Meshes that come
/// out much like a coarser one, as those of scenes with many polygons do, are left out. Throws
/// InputError.
std::vector<ChartMethod> chart_methods(const Scene& scene, const SolveSettings& base);

}  // namespace patchlight::server
