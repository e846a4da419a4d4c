#include "solver/form_factors/exchange_matrix.h"
#include "solver/form_factors/repair_closure.h"
#include "solver/make_engine.h"
#include "solver/mesh/make_patches.h"
#include "solver/solve_plan.h"
#include "solver/transport/gauss_seidel.h"
#include "solver/transport/patch_fields.h"
#include "solver/transport/residual.h"
#include "tests/stability/judgement.h"

#include <chrono>
#include <cmath>
#include <sstream>

namespace patchlight::stability::furnace_table_test {
namespace {

constexpr double patch_size = 0.5;
constexpr double tolerance = 1e-4;  // of the bound, and of the change that is shown to lie

Scene furnace(double reflectance) {
    SceneBuilder builder;
    builder.box("room", builder.material(reflectance, 1.0), {0, 0, 0}, {1, 1, 1}, true);
    return builder.scene;
}

/// Of a field on patches of one size against B = 1 / (1 − ρ), relative to B − E.
template <typename Value>
double true_error(double reflectance, std::size_t patches, const Value& value) {
    const double exact = 1.0 / (1.0 - reflectance);
    double squared = 0.0;
    for (std::size_t i = 0; i < patches; ++i) squared += std::pow(value(i) - exact, 2);
    return std::sqrt(squared / static_cast<double>(patches)) / (exact - 1.0);
}

std::string number(double value) { return figure(value); }

/// All its nines.
std::string nines(double reflectance) {
    std::ostringstream text;
    text << reflectance;
    return text.str();
}

void note_solve(double reflectance, Method method, const std::string& name) {
    SolveSettings settings = settings_of({Engine::analytic, method});
    settings.patch_size = patch_size;
    settings.tolerance = tolerance;
    const Solution solution = solve(furnace(reflectance), settings);
    ASSERT_TRUE(solution.within_tolerance) << name << " at " << reflectance;
    const double error = true_error(reflectance, solution.mesh.size(),
                                    [&](std::size_t i) { return solution.radiosity[i][0]; });
    const double floats = 2e-7 / (1.0 - reflectance);  // entries of the matrix, and their closure
    EXPECT_LE(error, *solution.error.algebraic_bound + floats) << name << " at " << reflectance;
    note_furnace({nines(reflectance), name, std::to_string(solution.convergence.back().iteration),
                  number(error), number(*solution.error.algebraic_bound), "–", "–",
                  number(solution.convergence.back().seconds)});
}

struct Swept {
    Field radiosity;
    int sweeps = 0;
    double change = 1.0, seconds = 0.0;
};

/// Stopped as is often done: when a sweep changes the field by less than the tolerance.
Swept sweep_until_still(const RadiosityProblem& problem) {
    const auto start = std::chrono::steady_clock::now();
    Swept swept{problem.exitance};
    for (; swept.change > tolerance; ++swept.sweeps) {
        const Field before = swept.radiosity;
        gauss_seidel_sweep(problem, swept.radiosity);
        double moved = 0.0, size = 0.0;
        for (std::size_t i = 0; i < problem.size(); ++i) {
            moved += std::pow(swept.radiosity[0][i] - before[0][i], 2);
            size += std::pow(swept.radiosity[0][i] - problem.exitance[0][i], 2);
        }
        swept.change = std::sqrt(moved / size);
    }
    swept.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return swept;
}

void note_stopped_by_change(double reflectance) {
    const Scene scene = furnace(reflectance);
    SolveSettings settings = settings_of({Engine::analytic, Method::gauss_seidel});
    settings.patch_size = patch_size;
    settings = plan_solve(scene, settings).settings;
    const MeshLines lines = find_mesh_lines(scene);
    const PatchMesh mesh = make_patches(scene, lines, patch_size);
    const RayScene rays(scene, lines.overlaps);
    const auto engine = make_engine(scene, mesh, rays, settings, [] { return true; });
    ExchangeMatrix exchange = build_exchange(*engine, scene, mesh, [](double) { return true; });
    repair_closure(exchange);
    const FormFactorMatrix factors(exchange);
    PatchFields fields = make_patch_fields(scene, mesh);
    const RadiosityProblem problem{factors, std::move(fields.area), std::move(fields.exitance),
                                   std::move(fields.reflectance)};
    const Swept swept = sweep_until_still(problem);
    const Field& radiosity = swept.radiosity;
    const double error =
        true_error(reflectance, mesh.size(), [&](std::size_t i) { return radiosity[0][i]; });
    const auto bound = measure_residual(problem, radiosity).algebraic_bound;
    // The change is ρ' of the one before, ρ' the factor of a sweep: what is left is ρ' / (1 − ρ')
    // of it, and ρ' is about ρ² for Gauss–Seidel.
    const double understated = error / swept.change, factor = reflectance * reflectance;
    EXPECT_GT(understated, 0.5 * factor / (1.0 - factor)) << reflectance;
    EXPECT_TRUE(!bound || *bound >= 0.99 * error) << "the bound of the same field does not lie";
    note_furnace({nines(reflectance), "sweeps until the change is below 1e-4",
                  std::to_string(swept.sweeps), number(error), bound ? number(*bound) : "none",
                  number(swept.change), number(understated), number(swept.seconds)});
}

TEST(Furnaces, AreSolvedToTheirBoundWhereTheChangeBetweenSweepsLies) {
    for (const double reflectance : {0.9, 0.99, 0.999, 0.9999}) {
        note_solve(reflectance, Method::gauss_seidel, "gauss-seidel");
        note_solve(reflectance, Method::shooting, "shooting");
        note_stopped_by_change(reflectance);
    }
}

}  // namespace
}  // namespace patchlight::stability::furnace_table_test
