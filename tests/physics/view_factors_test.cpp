#include "solver/mesh/make_patches.h"
#include "tests/physics/rooms.h"

#include <cmath>

namespace patchlight::view_factors_test {

namespace {

constexpr double quadrature = 1e-6;  // relative: three Gauss points an edge, and a float matrix
constexpr double visibility = 5e-3;  // relative: rays tell what is blocked
constexpr double deviations =
    4.0;  // of binomial noise: false alarm 1 in 16 000 for each comparison

/// Mean irradiance of `from`, everything black, while `to` gives off 1 W/m²: the factor from -> to.
Scene black_pair(const nlohmann::json& entry) {
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0), lit = builder.material(0.0, 1.0);
    builder.polygon("from", black, points_of(entry["from_vertices"]));
    builder.polygon("to", lit, points_of(entry["to_vertices"]));
    for (const auto& occluder : entry["occluders"])
        builder.polygon("occluder", black, points_of(occluder));
    return builder.scene;
}

}  // namespace

class EveryEngine : public testing::TestWithParam<Engine> {};

TEST_P(EveryEngine, MeetsThePublishedFactors) {
    const nlohmann::json file = reference("form_factors.json");
    int checked = 0;
    for (const auto& entry : file["cases"]) {
        if (entry["kind"] != "polygon-polygon") continue;
        SolveSettings settings;
        settings.engine = GetParam();
        if (GetParam() == Engine::ray_cast) settings.rays = 1024;
        const Solution solution = solve(black_pair(entry), settings);
        const double exact = entry["F_value"].get<double>();
        const double found = solution.objects[0].irradiance[0];
        double bound = exact * (entry["occluders"].empty() ? quadrature : visibility);
        if (GetParam() == Engine::ray_cast) {
            const PatchIndex patches =
                solution.mesh.first_of_surface[1];  // of `from`, the first surface
            bound =
                deviations * std::sqrt(exact * (1.0 - exact) /
                                       (*solution.settings.rays * static_cast<double>(patches)));
        }
        EXPECT_NEAR(found, exact, bound) << entry["id"] << " " << entry["title"];
        ++checked;
    }
    EXPECT_EQ(checked, 9);
}

INSTANTIATE_TEST_SUITE_P(ViewFactors, EveryEngine,
                         testing::Values(Engine::analytic, Engine::ray_cast),
                         [](const auto& each) { return name_of(each.param); });

/// The report names the share of a patch's light that goes to the wrong patch, the mean over some.
/// Proximity errs the same way on all patches of a polygon; half of it is taken from a patch for
/// each share that is given to another. Aliasing and visibility are independent from patch to
/// patch: four standard errors of the mean.
TEST(HemicubeViewFactors, MeetThePublishedFactorsToTheErrorsTheyReport) {
    const nlohmann::json file = reference("form_factors.json");
    int checked = 0;
    for (const auto& entry : file["cases"]) {
        if (entry["kind"] != "polygon-polygon") continue;
        const Scene scene = black_pair(entry);
        SolveSettings settings;
        settings.engine = Engine::hemicube;
        settings.hemicube_resolution = 64;
        settings.patch_size = 2.0 * patch_size_for(scene, 2000.0);
        const Solution solution = solve(scene, settings);
        const HemicubeErrors& errors = *solution.form_factors.hemicube;
        const double patches = solution.mesh.first_of_surface[1];
        const double bound = 2.0 * errors.proximity + deviations *
                                                          (errors.aliasing + errors.visibility) /
                                                          std::sqrt(patches);
        const double exact = entry["F_value"].get<double>();
        const double found = solution.objects[0].irradiance[0];
        EXPECT_NEAR(found, exact, bound) << entry["id"] << " " << entry["title"];
        EXPECT_LT(bound, 0.02) << "a bound that says something";
        RecordProperty(entry["id"].get<std::string>(),
                       std::to_string(found - exact) + " of " + std::to_string(bound));
        ++checked;
    }
    EXPECT_EQ(checked, 9);
}

TEST(Sensors, MeetTheElementFactors) {
    const nlohmann::json file = reference("form_factors.json");
    int checked = 0;
    for (const auto& entry : file["cases"]) {
        if (entry["kind"] != "element-polygon") continue;
        SceneBuilder builder;
        builder.polygon("to", builder.material(0.0, 1.0), points_of(entry["to_vertices"]));
        builder.sensor(point_of(entry["point"]), point_of(entry["normal"]));
        const Solution solution = solve(builder.scene, {});
        const double exact = entry["F_value"].get<double>();
        EXPECT_NEAR(solution.sensors[0].irradiance[0], exact, quadrature * exact) << entry["id"];
        ++checked;
    }
    EXPECT_EQ(checked, 5);
}

TEST(Sensors, MeetTheLuminairesOfTheNoriSuite) {
    const nlohmann::json entry = reference_case("form_factors.json", "ff-d16");
    for (const auto& luminaire : entry["cases"]) {
        SceneBuilder builder;
        const MaterialIndex lit = builder.material(0.0, 1.0);
        for (const auto& triangle : luminaire["triangles"]) {
            std::vector<Vec3> corners = points_of(triangle);
            const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            if (normal.dot(corners[0]) > 0.0)
                std::swap(corners[1], corners[2]);  // the front looks at the origin
            builder.polygon("luminaire", lit, corners);
        }
        builder.sensor(Vec3::Zero(), Vec3::UnitY());
        const double exact = std::stod(luminaire["exact_F"].get<std::string>());
        EXPECT_NEAR(solve(builder.scene, {}).sensors[0].irradiance[0], exact, quadrature * exact)
            << luminaire["luminaire"];
    }
}

TEST(ViewFactors, OfTheUnitCubeMeetTheMatrix) {
    const nlohmann::json entry = reference_case("form_factors.json", "ff-d15");
    const auto& order = entry["face_order"];
    for (std::size_t lit_face = 0; lit_face < order.size(); ++lit_face) {
        SceneBuilder builder;
        const MaterialIndex black = builder.material(0.0, 0.0), lit = builder.material(0.0, 1.0);
        for (std::size_t f = 0; f < order.size(); ++f)
            builder.polygon(order[f], f == lit_face ? lit : black,
                            points_of(entry["faces"][order[f].get<std::string>()]));
        const Solution solution = solve(builder.scene, {});
        for (std::size_t f = 0; f < order.size(); ++f) {
            const double exact = entry["F"][f][lit_face].get<double>();
            EXPECT_NEAR(solution.objects[f].irradiance[0], exact,
                        quadrature * std::max(exact, 0.1));
        }
        EXPECT_EQ(solution.form_factors.rays, 0u) << "nothing can block in a cube: no ray is due";
    }
}

}  // namespace patchlight::view_factors_test
