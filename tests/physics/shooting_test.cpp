#include "tests/physics/rooms.h"

#include <array>
#include <cmath>
#include <string>

namespace patchlight::shooting_test {

namespace {

Scene lit_cube(double reflectance) {
    SceneBuilder builder;
    builder.box("room", builder.material(reflectance, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.scene.surfaces[0].material = builder.material(reflectance, 1.0);
    return builder.scene;
}

Scene ceiling_light() {
    Scene scene = lit_cube(0.7);
    scene.surfaces[0].material = scene.surfaces[1].material;
    SceneBuilder builder{scene};
    builder.polygon("light", builder.material(0.7, 1.0),
                    {{0.25, 0.25, 1}, {0.25, 0.75, 1}, {0.75, 0.75, 1}, {0.75, 0.25, 1}});
    return builder.scene;
}

Scene six_patches(const nlohmann::json& entry) {
    SceneBuilder builder;
    builder.box("cube", builder.material(0.0, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    for (std::size_t f = 0; f < 6; ++f)
        builder.scene.surfaces[f].material =
            builder.material(entry["rho"][f].get<double>(), entry["E"][f].get<double>());
    return builder.scene;
}

/// Norms of a field over the patches: Σ A |x| and √(Σ A x²).
struct Norms {
    double first = 0.0, second = 0.0;
};
template <typename Value>
Norms norms(const Solution& solution, const Value& value) {
    Norms found;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        const double a = solution.mesh.patches[i].area, x = value(i);
        found.first += a * std::abs(x);
        found.second += a * x * x;
    }
    found.second = std::sqrt(found.second);
    return found;
}

/// How far two solutions are apart, Σ A |x| relative, and what their bounds allow: that of shooting
/// is in this norm, that of Gauss-Seidel in the other, and Σ A |x| <= √(Σ A) √(Σ A x²).
struct Apart {
    double distance = 0.0, allowed = 0.0;
};
Apart apart(const Scene& scene, SolveSettings settings) {
    settings.tolerance = 1e-3;
    settings.method = Method::gauss_seidel;
    const Solution swept = solve(scene, settings);
    settings.method = Method::shooting;
    const Solution shot = solve(scene, settings);
    EXPECT_TRUE(swept.within_tolerance && shot.within_tolerance);
    double area = 0.0;
    for (const Patch& patch : swept.mesh.patches) area += patch.area;
    const auto exitance = [&](PatchIndex i) {
        return scene.materials[scene.surfaces[swept.mesh.patches[i].surface].material].exitance[0];
    };
    const Norms reflected =
        norms(shot, [&](PatchIndex i) { return shot.radiosity[i][0] - exitance(i); });
    const Norms swept_reflected =
        norms(swept, [&](PatchIndex i) { return swept.radiosity[i][0] - exitance(i); });
    const Norms off =
        norms(shot, [&](PatchIndex i) { return shot.radiosity[i][0] - swept.radiosity[i][0]; });
    const double by_shooting = *shot.error.algebraic_bound * reflected.first,
                 by_sweeps = *swept.error.algebraic_bound * swept_reflected.second;
    return {off.first / reflected.first,
            (by_shooting + std::sqrt(area) * by_sweeps) / reflected.first};
}

SolveSettings with(Engine engine, double patch_size) {
    SolveSettings settings;
    settings.engine = engine;
    settings.patch_size = patch_size;
    return settings;
}

}  // namespace

TEST(Shooting, AgreesWithGaussSeidelToTheirBoundsWhereFactorsAreExact) {
    constexpr double floats =
        1e-6;  // rows are closed in double, the matrix in float: 6e-8 / (1 − ρ)
    std::vector<Scene> scenes{lit_cube(0.5), lit_cube(0.9), ceiling_light()};
    const nlohmann::json six = reference_case("solutions.json", "s-d05");
    for (const auto& each : six["cases"]) scenes.push_back(six_patches(each));
    EXPECT_GT(scenes.size(), 4u);
    for (std::size_t s = 0; s < scenes.size(); ++s)
        for (const double patch_size : {1.0, 0.125}) {
            const Apart found = apart(scenes[s], with(Engine::analytic, patch_size));
            EXPECT_LE(found.distance, found.allowed + floats) << "scene " << s;
            EXPECT_LT(found.allowed, 3e-3);
        }
}

struct Noise {
    Engine engine;
    double coarse;  // distance at 512 rays or cells, measured and doubled
};

/// Where rays or cells tell, shooting uses the row of one end as it comes, Gauss-Seidel what both
/// ends say together: they are the noise of rows apart, which falls with the number of rays (four
/// times as many: by half, or better).
TEST(Shooting, AgreesWithGaussSeidelToTheNoiseOfRows) {
    constexpr double half_and_some = 0.65;
    for (const Noise& noise : {Noise{Engine::analytic, 0.006}, Noise{Engine::ray_cast, 0.08},
                               Noise{Engine::hemicube, 0.06}}) {
        SolveSettings settings = with(noise.engine, 0.1);
        set_rays(settings, 512);
        const Apart coarse = apart(cornell_like(), settings);
        set_rays(settings, 2048);
        const Apart fine = apart(cornell_like(), settings);
        RecordProperty(name_of(noise.engine),
                       std::to_string(coarse.distance) + " then " + std::to_string(fine.distance));
        EXPECT_LT(coarse.distance, noise.coarse + coarse.allowed) << name_of(noise.engine);
        EXPECT_LT(fine.distance, half_and_some * coarse.distance + fine.allowed);
    }
}

namespace {

/// Area mean of the field that pictures show.
double shown_mean(const DisplayMesh& display) {
    double light = 0.0, area = 0.0;
    for (const auto& t : display.triangles) {
        const Vec3& p = display.positions[t[0]];
        const double a =
            0.5 * (display.positions[t[1]] - p).cross(display.positions[t[2]] - p).norm();
        area += a;
        for (const std::uint32_t v : t) light += a / 3.0 * display.radiosity[v][0];
    }
    return light / area;
}

/// Root mean square difference over vertices, relative.
double difference(const DisplayMesh& a, const DisplayMesh& b) {
    double squared = 0.0, size = 0.0;
    for (std::size_t v = 0; v < b.radiosity.size(); ++v) {
        squared += std::pow(a.radiosity[v][0] - b.radiosity[v][0], 2);
        size += std::pow(b.radiosity[v][0], 2);
    }
    return std::sqrt(squared / size);
}

struct Shown {
    int shots = 0;
    DisplayMesh display;
};

/// Pictures on the way, from when all four patches of the lamp have shot, about one for each
/// doubling of the shots, and the last.
std::vector<Shown> pictures_of(const Scene& scene, bool ambient, double tolerance = 1e-5) {
    SolveSettings settings = with(Engine::analytic, 0.08);
    settings.method = Method::shooting;
    settings.ambient = ambient;
    settings.tolerance = tolerance;
    std::vector<Shown> shown;
    int next = 4;
    const Solution solution = solve_scene(scene, settings, [&](const Progress& progress) {
        if (progress.picture && progress.iteration >= next) {
            shown.push_back({progress.iteration, (*progress.picture)()});
            next = 2 * progress.iteration;
        }
        return Verdict::go_on;
    });
    shown.push_back({next, solution.display});
    return shown;
}

}  // namespace

TEST(ShootingPictures, ConvergeOnTheFinalOne) {
    std::array<double, 2> early{};
    for (const bool ambient : {false, true}) {
        const std::vector<Shown> shown = pictures_of(cornell_like(), ambient);
        const DisplayMesh& last = shown.back().display;
        ASSERT_GT(shown.size(), 6u);
        std::vector<double> off;
        for (const Shown& each : shown) {
            ASSERT_EQ(each.display.radiosity.size(), last.radiosity.size());
            off.push_back(difference(each.display, last));
        }
        for (std::size_t k = 1; k < off.size(); ++k) EXPECT_LT(off[k], off[k - 1]) << k;
        EXPECT_LT(off[off.size() - 2], 1e-3);
        early[ambient] = off.front();
    }
    EXPECT_LT(early[1], 0.3 * early[0]) << "the ambient term makes the first pictures better";
}

/// With the ambient term the mean is right from the start in a closed room; in an open one it must
/// not count light that leaves. Without it half of the light is missing at first.
TEST(ShootingPictures, AreAsBrightOnAverageFromTheStart) {
    constexpr double few_percent = 0.02;
    for (const bool open : {false, true}) {
        const std::vector<Shown> shown = pictures_of(cornell_like(open), true);
        const double last = shown_mean(shown.back().display);
        std::string curve;
        for (const Shown& each : shown) {
            const double share = shown_mean(each.display) / last;
            curve += std::to_string(each.shots) + ": " + std::to_string(share) + "; ";
            EXPECT_NEAR(share, 1.0, few_percent) << each.shots << (open ? " open" : "");
        }
        RecordProperty(open ? "open" : "closed", curve);
    }
    const std::vector<Shown> plain = pictures_of(cornell_like(true), false);
    const double last = shown_mean(plain.back().display);
    EXPECT_LT(shown_mean(plain.front().display), 0.7 * last);
    for (const Shown& each : plain) EXPECT_LT(shown_mean(each.display), last * (1.0 + 1e-12));
}

/// The ambient term is no part of the solution.
TEST(ShootingPictures, AloneShowTheAmbientTerm) {
    SolveSettings settings = with(Engine::analytic, 0.2);
    settings.method = Method::shooting;
    settings.max_iterations = 8;
    settings.ambient = true;
    const Solution shown = solve(cornell_like(), settings);
    settings.ambient = false;
    const Solution plain = solve(cornell_like(), settings);
    EXPECT_EQ(shown.status, Status::limit);
    for (PatchIndex i = 0; i < plain.mesh.size(); ++i)
        ASSERT_TRUE((shown.radiosity[i] == plain.radiosity[i]).all());
    EXPECT_GT(shown_mean(shown.display), 1.3 * shown_mean(plain.display));
}

}  // namespace patchlight::shooting_test
