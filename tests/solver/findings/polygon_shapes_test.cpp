#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

namespace patchlight::polygon_shapes_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

TEST(Sliver, IsToldOfANeedleAndNotOfALath) {
    const auto with_width = [](double width) {
        Scene scene = lit_room();
        add_named(scene, "needle",
                  {Vec3(1.0, 1.0, 1.0), Vec3(2.0, 1.0, 1.0), Vec3(2.0, 1.0 + width, 1.0)},
                  two_sided);
        return scene;
    };
    const double on_it = 0.01;
    expect_told(with_width(1e-4), "sliver", {"needle"}, Vec3(5.0 / 3.0, 1.0, 1.0), on_it);
    EXPECT_EQ(told(with_width(1e-4))[0].count, 1u);  // of both sides, one
    expect_nothing_told(with_width(1e-2));
}

/// The room with its north wall in a lower and two upper parts; the vertex between these is `off`
/// the edge of the lower one.
Scene room_with_split_wall(double off) {
    Scene scene = lit_room("north");
    const Vec3 middle(1.5, 3.0, 1.0 + off);
    add_named(scene, "lower", rectangle(3.0 * y, 4.0 * x, 1.0 * z));
    add_named(scene, "upper-1", {Vec3(0, 3, 1), middle, Vec3(1.5, 3.0, 2.5), Vec3(0, 3, 2.5)});
    add_named(scene, "upper-2", {middle, Vec3(4, 3, 1), Vec3(4, 3, 2.5), Vec3(1.5, 3.0, 2.5)});
    return scene;
}

TEST(TVertex, IsToldWhereItStandsOffTheEdge) {
    for (const double off : {1e-4, 1e-2}) {
        const Vec3 vertex(1.5, 3.0, 1.0 + off);
        const double rounded = 1e-3;
        const std::vector<Finding> findings = told(room_with_split_wall(off));
        ASSERT_EQ(kinds(findings), "t-vertex ");
        ASSERT_EQ(findings[0].objects.size(), 2u);
        EXPECT_TRUE(findings[0].objects[0].starts_with("upper"));
        EXPECT_EQ(findings[0].objects[1], "lower");
        EXPECT_LE((place_of(findings[0]) - vertex).norm(), rounded) << findings[0].detail;
        EXPECT_FALSE(findings[0].remedy.empty());
    }
}

TEST(TVertex, IsNoneOnTheEdge) {
    expect_nothing_told(room_with_split_wall(0.0));
    expect_nothing_told(room_with_split_wall(1e-6));
}

}  // namespace
}  // namespace patchlight::polygon_shapes_test
