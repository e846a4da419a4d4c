#include "solver/display/light_sources.h"

#include "solver/scene/light.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::light_sources_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

std::vector<LightSource> sources_of(const Scene& scene, std::size_t most) {
    const MeshLines lines = find_mesh_lines(scene);
    const RayScene rays(scene, lines.overlaps);
    return find_light_sources(scene, lines, rays, most);
}

TEST(LightSources, AreTheEmittersMostPowerfulFirst) {
    Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
    add(scene, rectangle({0, 0, 2}, 0.5 * x, y), lamp);
    add(scene, rectangle({0, 0, 3}, 2 * x, y), lamp);
    add(scene, rectangle({0, 0, 4}, x, y), lamp);
    const std::vector<LightSource> sources = sources_of(scene, 10);
    ASSERT_EQ(sources.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sources[k].surface, (k + 1) % 3 + 1);
    EXPECT_DOUBLE_EQ(sources[0].power, 2.0);
    EXPECT_EQ(sources[1].normal, Vec3::UnitZ());
}

TEST(LightSources, LeaveOutWholeSurfacesBeyondTheLimit) {
    Scene scene = empty_scene();
    add(scene, rectangle({0, 0, 2}, 3 * x, 3 * y), lamp);
    add(scene, l_shape(), lamp);  // takes several convex pieces
    add(scene, rectangle({0, 0, 4}, 0.1 * x, y), lamp);
    const std::vector<LightSource> all = sources_of(scene, 100);
    ASSERT_GE(all.size(), 4u);
    EXPECT_EQ(sources_of(scene, 2).size(), 1u) << "not one piece of two";
    EXPECT_EQ(sources_of(scene, 0).size(), 0u);
}

TEST(LightSources, ThatAreConcaveGiveOffWhatTheirPiecesDo) {
    const Scene scene = [] {
        Scene with_l = empty_scene();
        add(with_l, l_shape(), lamp);
        return with_l;
    }();
    double power = 0.0;
    for (const LightSource& source : sources_of(scene, 100)) power += source.power;
    EXPECT_NEAR(power, scene.surfaces[0].area * luminance(scene.materials[lamp].exitance), 1e-12);
}

}  // namespace
}  // namespace patchlight::light_sources_test
