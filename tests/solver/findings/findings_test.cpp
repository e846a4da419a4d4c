#include "solver/findings/merge.h"
#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <random>

namespace patchlight::findings_test {
namespace {

TEST(Findings, AreAsManyOfAKindAsCanBeReadAndTheRestIsCounted) {
    std::vector<Finding> many{{"other", {"z"}, "once", "do", 1}};
    for (int k = 0; k < 9; ++k) many.push_back({"kind", {"o" + std::to_string(k)}, "d", "r", 2});
    const std::vector<Finding> merged = merge_alike(many);
    ASSERT_EQ(merged.size(), 7u);  // one, five, and one for the rest
    EXPECT_EQ(merged.back().objects, (std::vector<std::string>{"o5", "o6", "o7", "o8"}));
    EXPECT_EQ(merged.back().count, 8u);
    EXPECT_NE(merged.back().detail.find("4 more"), std::string::npos) << merged.back().detail;
    EXPECT_EQ(merged.back().remedy, "r");
}

TEST(Findings, OneTooManyIsToldRatherThanMerged) {
    EXPECT_EQ(merge_alike(std::vector<Finding>(6, {"kind", {}, "d", "r", 1})).size(), 6u);
}

/// Boxes strewn about a room, of which some float, are inside out or too near a wall.
Scene untidy_room() {
    Scene scene = lit_room("north");
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    add_named(scene, "north", rectangle(3.0 * y + 1e-3 * z, 4.0 * x, 2.4 * z));
    std::mt19937 chance(7);
    for (int k = 0; k < 12; ++k) {
        const Vec3 low(3.5 * uniform(chance), 2.5 * uniform(chance), k % 3 == 0 ? 1e-3 : 0.0);
        add_body(scene, "box-" + std::to_string(k), low, low + Vec3(0.4, 0.3, 0.5),
                 k % 4 == 0 ? Facing::inwards : Facing::outwards);
    }
    return scene;
}

TEST(Findings, AreTheSameWithAnyNumberOfThreads) {
    const Scene scene = untidy_room();
    const std::vector<Finding> once = told(scene);
    EXPECT_GE(once.size(), 3u);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const std::vector<Finding> again = told(scene);
    ASSERT_EQ(kinds(again), kinds(once));
    for (std::size_t k = 0; k < once.size(); ++k) {
        EXPECT_EQ(again[k].detail, once[k].detail);
        EXPECT_EQ(again[k].count, once[k].count);
    }
}

TEST(Findings, OfAnEmptySceneAreThoseOfReadingIt) {
    Scene scene = empty_scene();
    scene.findings.push_back({"default-material", {"a"}, "d", "r", 1});
    EXPECT_EQ(kinds(told(scene)), "default-material ");
}

}  // namespace
}  // namespace patchlight::findings_test
