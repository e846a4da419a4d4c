#include "solver/display/vertex_irradiance.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::vertex_irradiance_test {
namespace {

constexpr double rounding = 1e-12;

/// A sheet of four patches on a line and their display mesh, lit by what is given per patch.
Solution strip(Scene& scene, const std::vector<Rgb>& irradiance) {
    scene = scene_of(rectangle(Vec3::Zero(), Vec3::UnitX(), 0.25 * Vec3::UnitY()));
    Solution solution;
    solution.mesh = cut(scene, 0.25).mesh;
    EXPECT_EQ(solution.mesh.size(), irradiance.size());
    solution.irradiance = irradiance;
    const PatchMesh& mesh = solution.mesh;
    solution.display.positions = mesh.vertices;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const auto& corners = mesh.patches[i].vertices;
        solution.display.triangles.push_back({corners[0], corners[1], corners[2]});
        solution.display.triangles.push_back({corners[0], corners[2], corners[3]});
        solution.display.patch.insert(solution.display.patch.end(), {i, i});
    }
    solution.display.radiosity.assign(mesh.vertices.size(), Rgb::Zero());
    return solution;
}

TEST(VertexIrradiance, IsWhatRadiosityTells) {
    Scene scene;
    Solution solution = strip(scene, std::vector<Rgb>(4, Rgb::Constant(99.0)));
    scene.materials[white].exitance = Rgb(1, 0, 2);
    scene.materials[white].reflectance = Rgb(0.5, 0.25, 0.1);
    solution.display.radiosity.assign(solution.display.positions.size(), Rgb(3, 4, 5));
    for (const Rgb& irradiance : vertex_irradiance(scene, solution))
        EXPECT_LT((irradiance - Rgb(4, 16, 30)).abs().maxCoeff(), 30 * rounding);
}

TEST(VertexIrradiance, IsTheMeanOfThePatchesAroundWhereNothingIsReflected) {
    Scene scene;
    const std::vector<Rgb> light{Rgb::Constant(1), Rgb::Constant(3), Rgb::Constant(8),
                                 Rgb::Constant(2)};
    const Solution solution = strip(scene, light);
    scene.materials[white].reflectance = Rgb(0, 0, 1e-9);
    const std::vector<Rgb> irradiance = vertex_irradiance(scene, solution);
    for (std::size_t v = 0; v < irradiance.size(); ++v) {
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (const VertexIndex corner : solution.mesh.patches[i].vertices)
                if (corner == v) sum += light[i][0], ++count;
        ASSERT_GT(count, 0);
        EXPECT_LT((irradiance[v] - sum / count).abs().maxCoeff(), 8 * rounding) << v;
    }
}

TEST(VertexIrradiance, IsNeverNegative) {
    Scene scene;
    Solution solution = strip(scene, std::vector<Rgb>(4, Rgb::Zero()));
    scene.materials[white].exitance = Rgb::Constant(2);
    solution.display.radiosity.assign(solution.display.positions.size(), Rgb::Constant(1.9));
    for (const Rgb& irradiance : vertex_irradiance(scene, solution))
        EXPECT_EQ(irradiance.minCoeff(), 0.0);
}

}  // namespace
}  // namespace patchlight::vertex_irradiance_test
