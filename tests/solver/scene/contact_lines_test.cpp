#include "solver/scene/contact_lines.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::contact_lines_test {
namespace {

constexpr double rounding = 1e-12;  // of cuts of planes, lengths of order 1

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

double length(const Segment& s) { return (s[1] - s[0]).norm(); }

double total_length(const std::vector<Segment>& segments) {
    double sum = 0.0;
    for (const Segment& s : segments) sum += length(s);
    return sum;
}

/// Whether the segment runs through both points.
bool runs_through(const Segment& s, const Vec3& a, const Vec3& b) {
    const auto on = [&](const Vec3& p) {
        return (p - s[0]).norm() + (p - s[1]).norm() < length(s) + rounding;
    };
    return on(a) && on(b);
}

bool has(const std::vector<Segment>& segments, const Vec3& a, const Vec3& b) {
    return std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
        return ((s[0] - a).norm() < rounding && (s[1] - b).norm() < rounding) ||
               ((s[0] - b).norm() < rounding && (s[1] - a).norm() < rounding);
    });
}

std::vector<std::vector<Segment>> contact_lines_of(const Scene& scene) {
    return find_contact_lines(scene, find_coplanar_overlaps(scene));
}

TEST(ContactLines, WallsThatMeetAtTheirEdgesHaveNone) {
    for (const auto& lines : contact_lines_of(room())) EXPECT_TRUE(lines.empty());
    for (const auto& lines : contact_lines_of(moved(room(), {3.0, Vec3(9, 1, -5), odd_turn()})))
        EXPECT_TRUE(lines.empty());
}

TEST(ContactLines, ABoxOnTheFloorLeavesItsFourFootEdges) {
    const auto lines = contact_lines_of(room_with_box());
    const Vec3 a(0.2, 0.3, 0), b(0.55, 0.3, 0), c(0.55, 0.6, 0), d(0.2, 0.6, 0);
    ASSERT_EQ(lines[0].size(), 4u);
    EXPECT_TRUE(has(lines[0], a, b));
    EXPECT_TRUE(has(lines[0], b, c));
    EXPECT_TRUE(has(lines[0], c, d));
    EXPECT_TRUE(has(lines[0], d, a));
    for (SurfaceIndex s = 1; s < lines.size(); ++s) EXPECT_TRUE(lines[s].empty()) << s;
}

TEST(ContactLines, ABoxWithoutABottomLeavesThemToo) {
    Scene scene = room_with_box();
    scene.surfaces.erase(scene.surfaces.begin() + 6);
    EXPECT_EQ(contact_lines_of(scene)[0].size(), 4u);
}

TEST(ContactLines, AWallThroughTheFloorIsCutByItAndCutsIt) {
    const Scene scene =
        scene_of({rectangle(Vec3(0, 0, 0), x, y), rectangle(Vec3(0.25, 0.5, -0.3), 0.5 * x, z)});
    const auto lines = contact_lines_of(scene);
    const Vec3 a(0.25, 0.5, 0), b(0.75, 0.5, 0);
    ASSERT_EQ(lines[0].size(), 1u);
    EXPECT_TRUE(has(lines[0], a, b));
    ASSERT_EQ(lines[1].size(), 1u);
    EXPECT_TRUE(runs_through(lines[1][0], a, b));  // all of the floor's cut, also past the wall
}

TEST(ContactLines, BothSidesOfAPartitionLeaveOneLine) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.4, 0, 0), y, z), two_sided);
    const auto lines = contact_lines_of(scene);
    for (const SurfaceIndex crossed : {0u, 1u, 4u, 5u}) {  // floor, ceiling, low y, high y
        EXPECT_EQ(lines[crossed].size(), 1u) << crossed;
        EXPECT_NEAR(total_length(lines[crossed]), 1.0, rounding);
    }
    for (const SurfaceIndex clear : {2u, 3u, 6u, 7u}) EXPECT_TRUE(lines[clear].empty()) << clear;
}

TEST(ContactLines, EachLegOfATableCutsForItself) {
    const Polygon table{{0.2, 0.5, -0.3}, {0.3, 0.5, -0.3}, {0.3, 0.5, 0.4}, {0.7, 0.5, 0.4},
                        {0.7, 0.5, -0.3}, {0.8, 0.5, -0.3}, {0.8, 0.5, 0.5}, {0.2, 0.5, 0.5}};
    const auto lines = contact_lines_of(scene_of({rectangle(Vec3(0, 0, 0), x, y), table}));
    ASSERT_EQ(lines[0].size(), 2u);
    EXPECT_TRUE(has(lines[0], Vec3(0.2, 0.5, 0), Vec3(0.3, 0.5, 0)));
    EXPECT_TRUE(has(lines[0], Vec3(0.7, 0.5, 0), Vec3(0.8, 0.5, 0)));
}

TEST(ContactLines, WhatHoversAMillionthOfItsSizeAboveIsInContact) {
    for (const auto& [gap, count] : {std::pair(0.9e-6, 4u), {1.1e-6, 0u}}) {
        Scene scene = empty_scene();
        add_box(scene, Vec3::Zero(), Vec3::Ones(), Facing::inwards);
        const double height = gap * std::hypot(0.5, 0.8);
        add_box(scene, Vec3(0.2, 0.3, height), Vec3(0.7, 0.8, 0.8), Facing::outwards);
        EXPECT_EQ(contact_lines_of(scene)[0].size(), count) << gap;
    }
}

TEST(ContactLines, AWallBesideTheFloorLeavesNone) {
    const auto lines = contact_lines_of(
        scene_of({rectangle(Vec3(0, 0, 0), x, y), rectangle(Vec3(1.2, 0, -0.5), y, z)}));
    EXPECT_TRUE(lines[0].empty());
    EXPECT_TRUE(lines[1].empty());
}

TEST(ContactLines, AWallAcrossTheNotchOfAnLTouchesNothingThere) {
    const Polygon wall = rectangle(Vec3(1, 0.8, -0.5), x, z);  // above the notch, y > 0.7
    EXPECT_TRUE(contact_lines_of(scene_of({l_shape(), wall}))[0].empty());
}

TEST(ContactLines, MoveWithTheScene) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
        const Motion motion{scale, scale * Vec3(10, -5, 3), odd_turn()};
        const auto lines = contact_lines_of(moved(room_with_box(), motion));
        EXPECT_EQ(lines[0].size(), 4u) << scale;
        EXPECT_NEAR(total_length(lines[0]) / scale, 1.3, 1e-9) << scale;
    }
}

}  // namespace
}  // namespace patchlight::contact_lines_test
