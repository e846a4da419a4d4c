#include "server/run_job.h"
#include "server/scene_json.h"
#include "solver/solve_scene.h"
#include "solver/view_factors.h"
#include "tests/server/lit_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace patchlight::server::odd_scenes_test {
namespace {

constexpr double rounding = 1e-6;         // of factors, which are kept in single precision
constexpr double energy_rounding = 1e-4;  // what a solve stops at

/// A scene that is strange and yet right.
struct OddScene {
    std::string text;
    std::string finding;  // kind that it is told with; empty: none
};

void expect_finite(const std::string& pfm) {
    const std::size_t pixels = 3 * 8 * 8;
    ASSERT_GT(pfm.size(), pixels * sizeof(float));
    std::vector<float> values(pixels);
    std::memcpy(values.data(), pfm.data() + pfm.size() - pixels * sizeof(float),
                pixels * sizeof(float));
    for (const float value : values) EXPECT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
}

/// That the result holds finite numbers alone, run_job sees to by itself.
void expect_solved(const OddScene& odd, Engine engine) {
    Job job = read_scene_text(odd.text);
    job.settings.engine = engine;
    if (engine == Engine::hemicube) job.settings.hemicube_resolution = 32;
    if (engine == Engine::ray_cast) job.settings.rays = 256;
    const PictureRequest picture{job.cameras.front(), {ImageFormat::pfm}, {}, {}};
    const JobResult result = run_job(job, {picture}, 0.0, {});
    EXPECT_EQ(result.solution.status, Status::converged) << odd.text;
    const EnergyReport& energy = result.solution.energy;  // 4 standard errors: 1 in 16 000
    EXPECT_LT(energy.defect, energy_rounding + 4.0 * energy.standard_error) << odd.text;
    expect_finite(result.images.at(0).bytes);
    std::string found;
    for (const Finding& finding : result.solution.findings)
        // What is odd may be too small to be lit, and is of any size.
        if (finding.kind != "wasted-light" && finding.kind != "unlikely-size")
            found += finding.kind + " ";
    EXPECT_EQ(found, odd.finding.empty() ? "" : odd.finding + " ") << odd.text;
}

void expect_factors_are_shares(const std::string& text) {
    const Job job = read_scene_text(text);
    const auto check = [&](const GroupFactors& row) {
        double sum = 0.0;
        for (std::size_t k = 0; k < row.to.size(); ++k) {
            EXPECT_TRUE(row.factors[k] >= 0.0 && std::isfinite(row.errors[k])) << text;
            sum += row.factors[k];
        }
        EXPECT_LE(sum, 1.0 + rounding) << text;
    };
    ViewFactorSolver(job.scene, job.settings, Grouping::patch).find(check, {});
}

void expect_each_solved(const std::vector<OddScene>& scenes) {
    for (const OddScene& odd : scenes) {
        for (const Engine engine : {Engine::analytic, Engine::ray_cast, Engine::hemicube})
            expect_solved(odd, engine);
        expect_factors_are_shares(odd.text);
    }
}

std::string needle(const std::string& width) {
    return lit_object(R"("polygon": [[0,0,0.5],[1,0,0.5],[1,)" + width + ",0.5]]");
}

std::string scaled(const std::string& transform) {
    return lit_square(R"({"objects": [{"name": "all", )" + transform + R"(, "children": [
        {"name": "floor", "material": "white", "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
        {"name": "lamp", "material": "lamp", "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]}]}],
        "solve": {"patch_size": null}, "cameras": null})");
}

TEST(OddScenes, Needles) {
    expect_each_solved({{needle("1e-2"), ""},
                        {needle("1e-4"), "sliver"},
                        {needle("1e-5"), "sliver"},
                        {needle("1e-7"), "sliver"},
                        {needle("1e-10"), "degenerate-dropped"}});
}

TEST(OddScenes, PolygonsWithoutArea) {
    expect_each_solved(
        {{lit_object(R"("polygon": [[0,0,0.5],[1,0,0.5],[2,0,0.5]])"), "degenerate-dropped"},
         {lit_object(R"("polygon": [[0,0,0.5],[0,0,0.5],[0,0,0.5]])"), "degenerate-dropped"},
         {lit_object(R"("polygon": [[0,0,0.5],[0,0,0.5],[1,0,0.5],[1,1,0.5]])"), ""},
         {lit_object(R"("polygon": [[0,0,0.5],[1e-10,0,0.5],[0,1e-10,0.5]])"), ""}});
}

TEST(OddScenes, LightAndDark) {
    expect_each_solved(
        {{lit_square(R"({"materials": {"lamp": {"exitance": 0}}})"), "no-emitter"},
         {lit_square(R"({"materials": {"lamp": {"reflectance": 0}, "white": {"reflectance": 0}}})"),
          ""},
         {lit_square(R"({"materials": {"lamp": {"reflectance": 0.9999999},
                                       "white": {"reflectance": 0.9999999}}})"),
          ""},
         {lit_square(R"({"materials": {"lamp": {"exitance": 1e-30}}})"), ""},
         {lit_square(R"({"materials": {"lamp": {"exitance": 1e15}}})"), ""},
         {lit_square(R"({"materials": {"lamp": {"two_sided": true},
                                       "white": {"two_sided": true}}})"),
          ""}});
}

TEST(OddScenes, PolygonsThatMeet) {
    const std::string square = R"("polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]])";
    const auto three = [&](const std::string& third) {
        return lit_object(square + R"(}, {"name": "other", "material": "white", )" + third);
    };
    expect_each_solved(
        {{three(square), "coplanar-overlap"},
         {three(R"("polygon": [[0,1,0],[1,1,0],[1,0,0],[0,0,0]])"), ""},
         {three(R"("polygon": [[0.5,0,-1],[0.5,1,-1],[0.5,1,0.9],[0.5,0,0.9]])"), ""},
         {lit_object(R"("polygon": [[0,0,0.5],[1,0,0.8],[1,1,0.5],[0,1,0.8]])"), "non-planar"}});
}

TEST(OddScenes, SizesAndPlaces) {
    expect_each_solved({{scaled(R"("scale": 1e-9)"), ""},
                        {scaled(R"("scale": 1e8)"), ""},
                        {scaled(R"("scale": [1,1,-1])"), ""},
                        {scaled(R"("translation": [1e8,-1e8,1e8])"), ""}});
}

TEST(OddScenes, SensorsInCornersWallsAndFarAway) {
    const std::string scene = lit_square(R"({"sensors": [
        {"name": "on the floor", "position": [0.5,0.5,0], "normal": [0,0,1]},
        {"name": "below it", "position": [0.5,0.5,0], "normal": [0,0,-1]},
        {"name": "in the lamp", "position": [0.5,0.5,1], "normal": [0,0,1]},
        {"name": "in a corner", "position": [0,0,0], "normal": [1,1,1]},
        {"name": "far away", "position": [1e8,0,0], "normal": [-1,0,0]}]})");
    expect_each_solved({{scene, "sensor-misplaced"}});
    const Job job = read_scene_text(scene);
    const Solution solution = solve_scene(job.scene, job.settings, {});
    EXPECT_GT(luminance(solution.sensors[0].irradiance), 2.0);
    EXPECT_EQ(luminance(solution.sensors[1].irradiance), 0.0);
    EXPECT_EQ(luminance(solution.sensors[2].irradiance), 0.0);
    EXPECT_LT(luminance(solution.sensors[4].irradiance), 1e-12);
}

}  // namespace
}  // namespace patchlight::server::odd_scenes_test
