#include "tests/physics/rooms.h"

#include <array>
#include <cmath>

namespace patchlight::known_solutions_test {

namespace {

constexpr std::array<const char*, 6> face_names{"x0", "x1", "y0", "y1", "z0", "z1"};

/// Inside of the unit cube, face by face, each a grid whose first direction is the next axis
/// cyclically (x-face: y, z; y-face: z, x; z-face: x, y).
struct Face {
    Vec3 origin, u, v;
    bool flipped = false;  // u × v points out of the cube
    std::vector<Vec3> cell(double u0, double u1, double v0, double v1) const {
        std::vector<Vec3> corners{origin + u0 * u + v0 * v, origin + u1 * u + v0 * v,
                                  origin + u1 * u + v1 * v, origin + u0 * u + v1 * v};
        if (flipped) std::swap(corners[1], corners[3]);
        return corners;
    }
};

Face cube_face(std::size_t number) {
    const int axis = static_cast<int>(number / 2);
    Face face;
    face.u = Vec3::Unit((axis + 1) % 3);
    face.v = Vec3::Unit((axis + 2) % 3);
    face.flipped = number % 2 == 1;
    face.origin = face.flipped ? Vec3(Vec3::Unit(axis)) : Vec3(Vec3::Zero());
    return face;
}

SolveSettings analytic(double patch_size) {
    SolveSettings settings;
    settings.engine = Engine::analytic;
    settings.patch_size = patch_size;
    settings.tolerance = 1e-9;
    return settings;
}

}  // namespace

TEST(SixPatchCube, MeetsTheExactSystem) {
    const nlohmann::json entry = reference_case("solutions.json", "s-d05");
    for (const auto& each : entry["cases"]) {
        SceneBuilder builder;
        double highest = 0.0;
        for (std::size_t f = 0; f < 6; ++f) {
            const double rho = each["rho"][f].get<double>();
            highest = std::max(highest, rho);
            builder.polygon(face_names[f], builder.material(rho, each["E"][f].get<double>()),
                            cube_face(f).cell(0, 1, 0, 1));
        }
        const Solution solution = solve(builder.scene, analytic(1.0));
        ASSERT_EQ(solution.mesh.size(), 6u);
        const double bound = highest > 0.8 ? 1e-4 : 1e-6;  // a float matrix costs 3e-8 / (1 − ρ)
        for (std::size_t f = 0; f < 6; ++f)
            EXPECT_NEAR(solution.radiosity[f][0], each["B"][f].get<double>(),
                        bound * each["B"][f].get<double>());
    }
}

class LitCube : public EveryEngineAndMethod {};

void expect_face_means(const Scene& scene, const nlohmann::json& entry, const Way& way,
                       double emitting_patch_size) {
    SolveSettings settings = settings_of(way);
    settings.patch_size = emitting_patch_size;
    set_rays(settings, settings.engine == Engine::hemicube ? 48 * 48 : 4096);
    const Solution solution = solve(scene, settings);
    constexpr double face_mean =
        1e-3;  // discretisation 2.3e-4 at 16 patches an edge (s-d06), and as much by rays
    for (const char* name : face_names) {
        Rgb power = Rgb::Zero();
        double area = 0.0;
        for (std::size_t o = 0; o < scene.objects.size(); ++o)
            if (scene.objects[o].name.rfind(name, 0) == 0) {
                power += solution.objects[o].radiosity * solution.objects[o].area;
                area += solution.objects[o].area;
            }
        const double exact = entry["faces"][name]["B_mean"].get<double>();
        EXPECT_NEAR(power[0] / area, exact, face_mean * exact) << name;
    }
}

TEST_P(LitCube, MeetsFaceMeansOfALitFloor) {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(0.5, 0.0), lit = builder.material(0.5, 1.0);
    for (std::size_t f = 0; f < 6; ++f)
        builder.polygon(face_names[f], f == 4 ? lit : wall, cube_face(f).cell(0, 1, 0, 1));
    expect_face_means(builder.scene, reference_case("solutions.json", "s-d06"), GetParam(),
                      1.0 / 16);
}

TEST_P(LitCube, MeetsFaceMeansOfACeilingLight) {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(0.7, 0.0), lit = builder.material(0.7, 1.0);
    for (std::size_t f = 0; f < 6; ++f)
        builder.polygon(face_names[f], wall, cube_face(f).cell(0, 1, 0, 1));
    builder.polygon("z1 light", lit,
                    cube_face(5).cell(0.25, 0.75, 0.25, 0.75));  // covers the ceiling there
    // The ceiling's hidden quarter is no part of the published mean: its area goes to the light.
    Scene& scene = builder.scene;
    SolveSettings settings = settings_of(GetParam());
    settings.patch_size = 1.0 / 16;
    set_rays(settings, settings.engine == Engine::hemicube ? 48 * 48 : 4096);
    const Solution solution = solve(scene, settings);
    const nlohmann::json entry = reference_case("solutions.json", "s-d07");
    constexpr double face_mean = 1e-3;
    std::array<double, 6> power{}, area{};
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        if (solution.mesh.patches[i].covered) continue;
        const std::string& name =
            scene.objects[scene.surfaces[solution.mesh.patches[i].surface].object].name;
        for (std::size_t f = 0; f < 6; ++f)
            if (name.rfind(face_names[f], 0) == 0) {
                power[f] += solution.radiosity[i][0] * solution.mesh.patches[i].area;
                area[f] += solution.mesh.patches[i].area;
            }
    }
    for (std::size_t f = 0; f < 6; ++f) {
        EXPECT_NEAR(area[f], 1.0, 1e-9);
        const double exact = entry["faces"][face_names[f]]["B_mean"].get<double>();
        EXPECT_NEAR(power[f] / area[f], exact, face_mean * exact) << face_names[f];
    }
}

INSTANTIATE_TEST_SUITE_P(EveryWay, LitCube, testing::ValuesIn(every_way()), way_name);

TEST(ManufacturedSolution, ErrsNoMoreThanAPerfectPiecewiseConstantSolver) {
    const nlohmann::json entry = reference_case("solutions.json", "s-d09");
    constexpr std::size_t n = 8;
    SceneBuilder builder;
    for (std::size_t f = 0; f < 6; ++f)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n,
                             h = 1.0 / n;
                builder.polygon(
                    face_names[f],
                    builder.material(0.5, entry["E_patch_mean"][face_names[f]][i][j].get<double>()),
                    cube_face(f).cell(a, a + h, b, b + h));
            }
    const Solution solution = solve(builder.scene, analytic(1.0));
    ASSERT_EQ(solution.mesh.size(), 6 * n * n);
    double squared = 0.0, size = 0.0, worst = 0.0;
    for (std::size_t p = 0; p < solution.mesh.size(); ++p) {
        const double exact =
            entry["B_patch_mean"][face_names[p / (n * n)]][p / n % n][p % n].get<double>();
        const double error = solution.radiosity[p][0] - exact;
        squared += error * error;
        size += exact * exact;
        worst = std::max(worst, std::abs(error));
    }
    const auto& perfect = entry["error_of_exact_factor_P0_galerkin"][3];
    ASSERT_EQ(perfect["patches_per_edge"], n);
    constexpr double slack = 1.1;  // within 10 % of what cannot be avoided
    EXPECT_LT(std::sqrt(squared / size), slack * perfect["rel_L2_error"].get<double>());
    EXPECT_GT(std::sqrt(squared / size), perfect["rel_L2_error"].get<double>() / slack);
    EXPECT_LT(worst, slack * perfect["max_abs_error"].get<double>());
}

TEST(CieTestCase, ReflectedLightOfAFloorMeetsThePublishedPercentages) {
    const nlohmann::json entry = reference_case("solutions.json", "s-d10");
    SceneBuilder builder;
    builder.polygon("S2", builder.material(0.0, 1.0), {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    for (const auto& row : entry["rows"])
        builder.sensor(point_of(row["pos"]), point_of(row["normal"]));
    const Solution solution = solve(builder.scene, {});
    for (std::size_t s = 0; s < builder.scene.sensors.size(); ++s) {
        const double percent = 100.0 * solution.sensors[s].irradiance[0];
        EXPECT_NEAR(percent, entry["rows"][s]["published_pct"].get<double>(), 0.01 * percent);
        EXPECT_NEAR(percent, entry["rows"][s]["exact_pct"].get<double>(), 1e-6 * percent);
    }
}

TEST(Penumbra, MeetsTheClippedLightAtSensorsAndOnPatches) {
    const nlohmann::json entry = reference_case("solutions.json", "s-d12");
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0);
    builder.polygon("light", builder.material(0.0, 1.0), points_of(entry["light"]));
    builder.polygon("occluder", black, points_of(entry["occluder"]));
    for (const auto& patch : entry["patch_means"])
        builder.polygon("floor", black, points_of(patch["patch"]));
    for (const auto& point : entry["points"])
        builder.sensor({point["x"].get<double>(), 0.0, 0.0}, Vec3::UnitZ());
    for (const double patch_size : {0.05, 0.5}) {
        SolveSettings settings = analytic(patch_size);
        const Solution solution = solve(builder.scene, settings);
        for (std::size_t s = 0; s < builder.scene.sensors.size(); ++s) {
            const double exact = entry["points"][s]["visible_F"].get<double>();
            EXPECT_NEAR(solution.sensors[s].irradiance[0], exact, 0.01 * exact)
                << "x = " << entry["points"][s]["x"] << ", patches of " << patch_size;
        }
        for (std::size_t p = 0; p < entry["patch_means"].size(); ++p) {
            const double exact = entry["patch_means"][p]["mean_visible_F"].get<double>();
            EXPECT_NEAR(solution.objects[2 + p].irradiance[0], exact, 0.01 * exact)
                << "patch " << p << ", patches of " << patch_size;
        }
    }
}

}  // namespace patchlight::known_solutions_test
