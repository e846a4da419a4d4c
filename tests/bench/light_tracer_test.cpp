#include "tests/bench/light_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::light_tracer_test {

namespace {

constexpr double sure = 4.0;  // standard errors: 1 in 16 000
constexpr MaterialIndex dull = 0, glowing = 1, black_lamp = 2, both_sides = 3, black = 4;

class Room {
  public:
    Room() {
        scene.materials = {{"dull", Rgb::Constant(0.5), Rgb::Zero()},
                           {"glowing", Rgb::Constant(0.5), Rgb::Ones()},
                           {"lamp", Rgb::Zero(), Rgb::Ones()},
                           {"both sides", Rgb::Constant(0.5), Rgb::Zero(), true},
                           {"black", Rgb::Zero(), Rgb::Zero(), true}};
        scene.objects = {{"all"}};
    }
    /// Its front is where a × b points.
    SurfaceIndex add(MaterialIndex material, const Vec3& o, const Vec3& a, const Vec3& b) {
        const std::vector<Vec3> corners{o, o + a, o + a + b, o + b};
        add_polygon(scene, 0, material, face_++, corners, "/objects");
        return static_cast<SurfaceIndex>(scene.surfaces.size() - 1);
    }
    Scene scene;

  private:
    std::uint32_t face_ = 0;
};

const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

Scene unit_cube(MaterialIndex material) {
    Room room;
    room.add(material, o, x, y);
    room.add(material, z, y, x);
    room.add(material, o, y, z);
    room.add(material, x, z, y);
    room.add(material, o, z, x);
    room.add(material, y, x, z);
    return room.scene;
}

LightTracer traced(const Scene& scene, double landings = 5e4, std::size_t searches = 800) {
    return {scene, {landings, 200.0, searches, 1}};
}

void expect_arriving(const LightTracer& truth, SurfaceIndex s, double exact) {
    const SurfaceIndex surfaces[] = {s};
    EXPECT_NEAR(truth.arriving(s)[0], exact, sure * truth.arriving_error(surfaces)[0]);
    EXPECT_LT(truth.arriving_error(surfaces)[0], 0.02 * exact);  // or it says nothing
}

}  // namespace

TEST(LightTracer, FacingUnitSquaresMatchTheClosedForm) {
    Room room;
    room.add(black_lamp, o, x, y);
    const SurfaceIndex above = room.add(dull, z, y, x);
    expect_arriving(traced(room.scene), above, 0.199825);  // unit squares facing at distance 1
}

TEST(LightTracer, FurnaceHoldsExitanceOverAbsorptanceEverywhere) {
    const Scene scene = unit_cube(glowing);
    const LightTracer truth = traced(scene);
    for (SurfaceIndex s = 0; s < 6; ++s) expect_arriving(truth, s, 1.0 / (1.0 - 0.5));
}

TEST(LightTracer, AFieldIsAsWrongAsItIsMade) {
    const Scene scene = unit_cube(glowing);
    const LightTracer truth = traced(scene);
    const double exact = 0.5 * 2.0;  // reflected per area
    for (const double off : {0.0, 0.1}) {
        std::vector<double> shown;
        for (std::size_t i = 0; i < truth.bins().size(); ++i)
            shown.push_back((1.0 + off) * exact * truth.bins().area(i));
        const TrueError error = truth.error_of(shown);
        // Of the square, which is what noise is added to.
        const double sigma = error.high * error.high - error.value * error.value;
        EXPECT_NEAR(error.value * error.value, off * off, sure * sigma);
        EXPECT_LT(sigma, 0.005);
    }
}

TEST(LightTracer, BeamThroughAHoleCarriesRadianceTimesAreaTimesSolidAngle) {
    // A lamp of 4 cm lights, from 4 m above, a floor below a plate with a hole of 2 cm.
    Room room;
    const double far = 4.0, wide = 0.04, hole = 0.02;
    const SurfaceIndex floor = room.add(dull, o - 0.5 * (x + y), x, y);
    for (const double turn : {0.0, 0.5, 1.0, 1.5}) {  // a frame of four plates round the hole
        const double angle = std::numbers::pi * turn;
        const Vec3 u(std::cos(angle), std::sin(angle), 0), v(-u.y(), u.x(), 0);
        room.add(black, 0.5 * z + 0.5 * hole * (u - v), 2 * u, (2 + hole) * v);
    }
    room.add(black_lamp, (0.5 + far) * z - 0.5 * wide * (x + y), wide * y, wide * x);
    const double exact = std::pow(wide * hole / far, 2) / std::numbers::pi;
    const LightTracer truth = traced(room.scene, 2e4, 12000);
    expect_arriving(truth, floor, exact);  // cosines are 1 within 2 (0.03 / 4)² = 1e-4
}

TEST(LightTracer, WhatIsCoveredOrBehindTakesNoLight) {
    Room room;
    room.add(black_lamp, z, y, x);
    const SurfaceIndex floor = room.add(dull, o, x, y);
    const SurfaceIndex rug = room.add(dull, 0.25 * (x + y), 0.5 * x, 0.5 * y);
    const SurfaceIndex below = room.add(dull, o, y, x);            // the floor's other side
    const SurfaceIndex shelf = room.add(both_sides, 2 * z, x, y);  // two halves
    const LightTracer truth = traced(room.scene);
    const SurfaceIndex both[] = {floor, rug};
    EXPECT_NEAR((truth.arriving(floor) + truth.arriving(rug))[0], 0.199825,
                sure * truth.arriving_error(both)[0]);
    EXPECT_GT(truth.arriving(rug)[0], 0.25 * 0.199825);  // the middle gets more than its share
    EXPECT_EQ(truth.arriving(below)[0], 0.0);
    EXPECT_EQ(truth.arriving(shelf)[0], 0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < truth.bins().size(); ++i)
        if (truth.bins().surface(i) == floor) area += truth.bins().area(i);
    EXPECT_NEAR(area, 0.75, 0.02);  // by 4096 and more points: 1 % and less
}

}  // namespace patchlight::light_tracer_test
