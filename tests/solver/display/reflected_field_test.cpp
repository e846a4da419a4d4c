#include "solver/display/reflected_field.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::reflected_field_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

/// A plate of 4 m x 4 m in one patch that is dim but for a bright strip and a brighter one.
struct Strips {
    CutScene pieces = cut(scene_of(rectangle(Vec3::Zero(), 4 * x, 4 * y)), 9.0);
    RayScene rays{pieces.scene, pieces.lines.overlaps};
    PatchLocator locator{pieces.scene, pieces.mesh, rays};
    ReflectedField field;

    explicit Strips(double bright) : field(make(bright)) {}
    ReflectedField make(double bright) const {
        DisplayMesh display;
        std::vector<Rgb> values;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const Vec3 at = i * 0.25 * x;
            const double value = i == 3 ? bright : i == 9 ? 2.0 * bright : 1.0;
            for (const Vec3& corner :
                 {at, Vec3(at + 0.25 * x), Vec3(at + 0.25 * x + 4 * y), Vec3(at + 4 * y)}) {
                display.positions.push_back(corner);
                values.push_back(Rgb::Constant(value));
            }
            display.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
            display.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
        }
        display.patch.assign(display.triangles.size(), 0);
        return {pieces.scene, pieces.mesh, rays, locator,
                FieldTable(pieces.mesh, display, rays, values)};
    }
    ReflectedField::Seen at(double px) const {
        const RayPoint p = rays.to_ray_space({px, 2.0, 0.0});
        return field.at(0, p.x(), p.y(), p.z());
    }
};

TEST(ReflectedField, HasAnExcessOnlyWhereSomethingIsMuchBrighter) {
    EXPECT_FALSE(Strips(1.5).field.has_excess());
    const Strips strips(100.0);
    EXPECT_TRUE(strips.field.has_excess());
    EXPECT_EQ(strips.at(1.6).excess_share, 0.0f);
    EXPECT_GT(strips.at(0.8).excess_share, 0.8f);
    EXPECT_NEAR(strips.at(2.3).radiosity[1], 200.0, 1e-3);
}

TEST(ReflectedField, SamplesTheExcessAsOftenAsItsDensityTells) {
    const Strips strips(100.0);
    constexpr int count = 10'000;
    int brighter = 0;
    double whole = 0.0;  // mean of 1/density: the area the excess lies on
    for (int k = 0; k < count; ++k) {
        const float pick = (static_cast<float>(k) + 0.5f) / count;
        const ReflectedField::Sample sample = strips.field.sample(pick, 0.3f, 0.6f);
        ASSERT_GT(sample.seen.excess_share, 0.0f);
        const Vec3 at = strips.rays.from_ray_space(sample.position.cast<double>());
        EXPECT_FLOAT_EQ(strips.at(at.x()).density, sample.seen.density);
        brighter += at.x() > 2.0;
        whole += 1.0 / static_cast<double>(sample.seen.density) / count;
    }
    const double ratio =
        static_cast<double>(strips.at(2.3).density) / static_cast<double>(strips.at(0.8).density);
    EXPECT_NEAR(brighter, count * ratio / (1.0 + ratio), 2.0) << "picks are even";
    const double area = 2 * 0.25 * 4.0 * strips.rays.scale() * strips.rays.scale();
    EXPECT_NEAR(whole, area, 1e-3 * area);
}

}  // namespace
}  // namespace patchlight::reflected_field_test
