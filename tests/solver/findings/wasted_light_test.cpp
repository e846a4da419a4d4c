#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::wasted_light_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

std::vector<Finding> wasted(const Scene& scene) {
    std::vector<Finding> found = told(scene);
    std::erase_if(found, [](const Finding& finding) { return finding.kind != "wasted-light"; });
    return found;
}

TEST(WastedLight, IsToldOfALampThatShinesAwayFromAllThereIs) {
    Scene scene = lit_room("lamp");
    add_named(scene, "flush lamp", rectangle(Vec3(1, 1, 2.5), y, x), lamp);
    EXPECT_TRUE(wasted(scene).empty());
    add_named(scene, "roof lamp", rectangle(Vec3(1, 1, 3), x, y), lamp);
    const std::vector<Finding> found = wasted(scene);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].objects, std::vector<std::string>{"roof lamp"});
    EXPECT_NE(found[0].detail.find("leaves the scene"), std::string::npos) << found[0].detail;
}

/// As wasted, or as flipped, which says more: never without a word.
TEST(WastedLight, OfALampThatShinesAtBacksAloneIsTold) {
    Scene scene = empty_scene();
    add_named(scene, "panel", rectangle(Vec3(-50, -50, 0), 100 * y, 100 * x));  // looks down
    add_named(scene, "lamp", rectangle(Vec3(0, 0, 0.5), 0.1 * y, 0.1 * x), lamp);
    const std::vector<Finding> found = told(scene);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Finding& finding) {
        return finding.kind == "flipped-normals" ||
               (finding.kind == "wasted-light" &&
                finding.detail.find("ends at backs") != std::string::npos);
    }));
}

TEST(WastedLight, IsNoneWhereASmallOrFarSurfaceOrASensorGetsSome) {
    Scene scene = empty_scene();
    add_named(scene, "lamp", rectangle(Vec3::Zero(), x, y), lamp);
    EXPECT_EQ(wasted(scene).size(), 1u);
    Scene measured = scene;
    measured.sensors.push_back({"s", Vec3(0, 0, 5), -z});
    EXPECT_TRUE(wasted(measured).empty());
    add_named(scene, "speck", rectangle(Vec3(30, 0, 100), 0.01 * y, 0.01 * x));
    EXPECT_TRUE(wasted(scene).empty());
}

/// A floor under a ceiling of 4 m with a hole of 2 cm, or none, a sun 200 m above it.
TEST(WastedLight, IsNoneOfASunThatShinesThroughAHole) {
    for (const double hole : {0.02, 0.0}) {
        Scene scene = empty_scene();
        add_named(scene, "floor", rectangle(Vec3(-2, -2, 0), 4 * x, 4 * y));
        const double h = 0.5 * hole;
        const auto ceiling = [&](const Vec3& corner, const Vec3& first, const Vec3& second) {
            add_named(scene, "ceiling", rectangle(corner, second, first));
        };
        ceiling({-2, -2, 3}, 4 * x, (2 - h) * y);
        ceiling({-2, h, 3}, 4 * x, (2 - h) * y);
        if (hole > 0.0) {
            ceiling({-2, -h, 3}, (2 - h) * x, hole * y);
            ceiling({h, -h, 3}, (2 - h) * x, hole * y);
        }
        add_named(scene, "sun", rectangle(Vec3(-1, -1, 200), 2 * y, 2 * x), lamp);
        EXPECT_EQ(wasted(scene).empty(), hole > 0.0) << hole;
    }
}

}  // namespace
}  // namespace patchlight::wasted_light_test
