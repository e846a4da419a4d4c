#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace patchlight {

struct DisplayMesh;

enum class Method : std::uint8_t { automatic, gauss_seidel, shooting, hierarchical };
enum class Engine : std::uint8_t { automatic, hemicube, ray_cast, analytic };

/// The solve block of a scene. What is not given is chosen, and echoed in the result.
struct SolveSettings {
    Method method = Method::automatic;
    Engine engine = Engine::automatic;
    std::optional<double> accuracy;    // relative error asked for; 0.02 if none of patch_size,
                                       // rays, hemicube_resolution, tolerance, max_iterations is
                                       // given [1]
    std::optional<double> patch_size;  // longest patch edge; half of it: 4 times the patches [m]
    std::optional<int> rays;           // per patch; 4 times as many: half the noise [1]
    std::optional<int> hemicube_resolution;  // pixels along the top face's edge [pixels]
    std::optional<double> tolerance;  // algebraic bound at which sweeps stop, default 1e-4 [1]
    std::optional<int> max_iterations;
    std::optional<bool> ambient;  // shooting's display term
    std::uint64_t seed = 1;
    std::optional<double> time_limit;           // [s]
    std::optional<std::uint64_t> memory_limit;  // [bytes]
    int threads = 0;                            // 0: all cores
    bool measure_error = true;  // of hand-set solves, which nothing shown depends on; off where
                                // the time of the solve alone is wanted
};

enum class Stage : std::uint8_t { mesh, form_factors, solve, display };
enum class Verdict : std::uint8_t { go_on, stop };

/// What a long job tells after each step.
struct Progress {
    Stage stage = Stage::mesh;
    double fraction = 0.0;  // of this stage [1]
    int iteration = 0;
    double residual = 0.0;                        // of the solver, relative [1]
    std::optional<double> unshot = std::nullopt;  // shooting: share of the light not sent on [1]
    /// The display field so far, while there is one; good during the call.
    const std::function<DisplayMesh()>* picture = nullptr;
    /// The same without the ambient light that shooting adds to what is shown, where it adds any.
    const std::function<DisplayMesh()>* picture_without_ambient = nullptr;
};

/// Called after each step from the thread that called the solver; `stop` ends the work with what
/// there is so far.
using Observer = std::function<Verdict(const Progress&)>;

}  // namespace patchlight
