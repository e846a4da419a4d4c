#include "server/mesh_glb.h"

#include "server/scene_json.h"
#include "solver/solve_scene.h"
#include "tests/server/glb_reader.h"
#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::server::mesh_glb_test {
namespace {

struct SolvedBox {
    Job job = read_scene_text(small_box);
    Solution solution = solve_scene(job.scene, job.settings, {});
};

const SolvedBox& box() {
    static const SolvedBox solved;
    return solved;
}

constexpr double exposure = -1.0;

GlbReader box_mesh() { return GlbReader(mesh_glb(box().job, box().solution, exposure)); }

std::size_t triangle_count(const GlbReader& glb) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < glb.document["meshes"].size(); ++k)
        count += glb.indices(k).size() / 3;
    return count;
}

TEST(MeshGlb, IsWellFormed) { box_mesh().check(); }

TEST(MeshGlb, EveryObjectIsANodeUnderItsPath) {
    const auto nodes = box_mesh().document["nodes"];
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_EQ(nodes[0]["name"], "walls");
    EXPECT_EQ(nodes[1]["name"], "lamp");
    EXPECT_EQ(triangle_count(box_mesh()), box().solution.display.triangles.size());
}

TEST(MeshGlb, TrianglesKeepTheirFronts) {
    const GlbReader glb = box_mesh();
    const auto positions = glb.attribute(1, "POSITION");
    const auto corners = glb.indices(1);
    const auto at = [&](std::size_t k) { return Vec3(positions.at(corners.at(k)).data()); };
    for (std::size_t k = 0; k < corners.size(); k += 3)
        EXPECT_LT((at(k + 1) - at(k)).cross(at(k + 2) - at(k)).z(), 0.0);  // the lamp shines down
    EXPECT_EQ(glb.document["materials"][0]["doubleSided"], false);
}

TEST(MeshGlb, RadiosityIsExitancePlusReflectedIrradiance) {
    const GlbReader glb = box_mesh();
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        const Scene& scene = box().job.scene;
        const auto shown = std::find_if(scene.surfaces.begin(), scene.surfaces.end(),
                                        [&](const Surface& s) { return s.object == mesh; });
        const Material& material = scene.materials.at(shown->material);
        const auto radiosity = glb.attribute(mesh, "_RADIOSITY");
        const auto irradiance = glb.attribute(mesh, "_IRRADIANCE");
        for (std::size_t v = 0; v < radiosity.size(); ++v) {
            const double expected =
                material.exitance[0] + material.reflectance[0] * irradiance[v].at(0);
            EXPECT_NEAR(radiosity[v].at(0), expected, 1e-5 * expected);  // floats are stored
            EXPECT_GT(irradiance[v].at(0), 0.0);
        }
    }
}

TEST(MeshGlb, ColoursAreLinearAndThoseOfThePicture) {
    const GlbReader glb = box_mesh();
    const auto radiosity = glb.attribute(0, "_RADIOSITY");
    const auto colours = glb.attribute(0, "COLOR_0");
    constexpr double half_step = 0.5 / 65535 + 1e-7;  // of the colour, and of the float radiosity
    bool any_dark = false;
    for (std::size_t v = 0; v < colours.size(); ++v) {
        const double light = radiosity[v].at(0) / std::numbers::pi * std::exp2(exposure);
        EXPECT_NEAR(colours[v].at(0), std::min(1.0, light), half_step);
        EXPECT_EQ(colours[v].at(3), 1.0);
        any_dark |= light < 0.5;
    }
    EXPECT_TRUE(any_dark);
    for (const auto& colour : glb.attribute(1, "COLOR_0")) EXPECT_EQ(colour.at(0), 1.0);  // lamp
    EXPECT_TRUE(glb.document["materials"][0]["extensions"].contains("KHR_materials_unlit"));
    EXPECT_EQ(glb.document["asset"]["extras"]["exposure"], exposure);
}

TEST(MeshGlb, ASceneThatStandsAlongAnyAxisIsTurnedUpright) {
    EXPECT_FALSE(box_mesh().document["nodes"][0].contains("rotation"));
    for (const Vec3& up : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1),
                           Vec3(0, 0, -1), Vec3(0.1, 0, 1)}) {
        Job job = box().job;
        job.cameras[0].camera.up = up;
        const GlbReader glb(mesh_glb(job, box().solution, exposure));
        const auto q = glb.document["nodes"][0]["rotation"].get<std::vector<double>>();
        const Eigen::Quaterniond turn(q.at(3), q.at(0), q.at(1), q.at(2));
        const Vec3 nearest_axis = up.array().round();
        EXPECT_LT((turn * nearest_axis - Vec3::UnitY()).norm(), 1e-12) << up.transpose();
        EXPECT_NEAR(turn.norm(), 1.0, 1e-12);  // twelve digits: sines of 45 degrees, rounded
    }
}

TEST(MeshGlb, NothingShownIsStillAFile) {
    Solution nothing;
    const GlbReader glb(mesh_glb(box().job, nothing, exposure));
    EXPECT_FALSE(glb.document.contains("nodes"));
    EXPECT_EQ(glb.binary, "");
}

TEST(MeshGlb, TheCommandLineWritesItExposedAsThePictureIs) {
    const std::string solve = "solve " + small_box_file() + " --mesh m.glb ";
    EXPECT_EQ(run_program(solve + "--image m.png --stats m.json").code, 0);
    const GlbReader chosen(read_test_file("m.glb"));
    chosen.check();
    const auto stats = nlohmann::json::parse(read_test_file("m.json"));
    EXPECT_EQ(chosen.document["asset"]["extras"]["exposure"], stats["images"][0]["exposure"]);
    EXPECT_EQ(run_program(solve + "--exposure -2.5").code, 0);
    const GlbReader given(read_test_file("m.glb"));
    EXPECT_EQ(given.document["asset"]["extras"]["exposure"], -2.5);
}

TEST(MeshGlb, AnotherEndingIsRefused) {
    const Outcome outcome = run_program("solve no-scene.json --mesh m.gltf");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--mesh m.gltf: the name must end in .glb"), std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace patchlight::server::mesh_glb_test
