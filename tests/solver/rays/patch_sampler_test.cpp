#include "solver/rays/patch_sampler.h"

#include "solver/scene/coplanar.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

namespace patchlight::patch_sampler_test {
namespace {

constexpr int samples = 40000;
constexpr int bins = 8;         // along each side of the box round the patch
constexpr double sigmas = 4.5;  // of chi-square: 1 in 100 000 sound samplers fail
constexpr float below_one = 0.99999994f;

struct Shape {
    std::string name;
    Polygon polygon;
    bool parallelogram;
    friend std::ostream& operator<<(std::ostream& out, const Shape& shape) {
        return out << shape.name;
    }
};

double area_of(const std::vector<Vec2>& polygon) {
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        area += 0.5 * turn(polygon[0], polygon[k], polygon[k + 1]);
    return area;
}

struct Sampled {
    explicit Sampled(const Polygon& polygon)
        : plate(cut(scene_of(polygon), 100.0)),
          rays(plate.scene, plate.lines.overlaps),
          sampler(make_sampler(plate.mesh, 0, plate.scene.surfaces[0].normal, rays)) {
        for (const Vec3& p : patch_corners(plate.mesh, 0)) {
            const RayPoint q = rays.to_ray_space(p);
            outline.emplace_back(q.x(), q.y());
            box.extend(outline.back());
        }
    }
    Vec2 at(float u, float v) const { return sampler.at(u, v).head<2>().cast<double>(); }
    /// How far inside the outline [ray space].
    double depth(const Vec2& p) const {
        double least = 1e300;
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
            least = std::min(least, turn(a, b, p) / (b - a).norm());
        }
        return least;
    }
    std::vector<double> shares_by_area() const {
        std::vector<double> shares;
        const Vec2 cell = box.sizes() / bins;
        for (int j = 0; j < bins; ++j)
            for (int i = 0; i < bins; ++i) {
                const Vec2 low = box.min() + Vec2(i * cell.x(), j * cell.y()), high = low + cell;
                std::vector<Vec2> part = outline;
                part = clip_left(part, low, Vec2(high.x(), low.y()));
                part = clip_left(part, Vec2(high.x(), low.y()), high);
                part = clip_left(part, high, Vec2(low.x(), high.y()));
                part = clip_left(part, Vec2(low.x(), high.y()), low);
                shares.push_back(area_of(part) / area_of(outline));
            }
        return shares;
    }

    CutScene plate;
    RayScene rays;
    PatchSampler sampler;
    std::vector<Vec2> outline;
    Eigen::AlignedBox2d box;
};

class SamplerOn : public testing::TestWithParam<Shape> {};

TEST_P(SamplerOn, IsUniformOverTheArea) {
    const Sampled patch(GetParam().polygon);
    ASSERT_EQ(patch.plate.mesh.size(), 1u);
    EXPECT_EQ(patch.sampler.parallelogram, GetParam().parallelogram);
    std::vector<int> counts(bins * bins, 0);
    std::mt19937 chance(1);
    for (int n = 0; n < samples; ++n) {
        const float u = static_cast<float>(uniform(chance)) * below_one,
                    v = static_cast<float>(uniform(chance)) * below_one;
        const Vec2 place = (patch.at(u, v) - patch.box.min()).cwiseQuotient(patch.box.sizes());
        const int i = std::clamp(static_cast<int>(place.x() * bins), 0, bins - 1),
                  j = std::clamp(static_cast<int>(place.y() * bins), 0, bins - 1);
        ++counts[static_cast<std::size_t>(j * bins + i)];
    }
    const std::vector<double> shares = patch.shares_by_area();
    double chi_square = 0.0, degrees = -1.0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const double expected = samples * shares[k];
        if (expected < 10.0) continue;  // too few for the normal law
        chi_square += (counts[k] - expected) * (counts[k] - expected) / expected;
        degrees += 1.0;
    }
    EXPECT_LT(chi_square, degrees + sigmas * std::sqrt(2.0 * degrees));
}

TEST_P(SamplerOn, KeepsInsideTheOutline) {
    const Sampled patch(GetParam().polygon);
    std::mt19937 chance(2);
    double least = 1e300;
    for (int n = 0; n < samples; ++n)
        least =
            std::min(least, patch.depth(patch.at(static_cast<float>(uniform(chance)) * below_one,
                                                 static_cast<float>(uniform(chance)) * below_one)));
    EXPECT_GT(least, 0.0);
}

TEST_P(SamplerOn, KeepsInsideTheOutlineAtTheEndsOfItsCoordinates) {
    const Sampled patch(GetParam().polygon);
    const float share = patch.sampler.first_share;
    for (const float u : {0.0f, 1e-7f, 0.5f, share, std::nextafter(share, 0.0f), below_one})
        for (const float v : {0.0f, 1e-7f, 0.5f, below_one})
            EXPECT_GT(patch.depth(patch.at(std::min(u, below_one), v)), 0.0) << u << ' ' << v;
}

INSTANTIATE_TEST_SUITE_P(
    PatchSampler, SamplerOn,
    testing::Values(Shape{"square", flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), true},
                    Shape{"parallelogram", flat({{0, 0}, {1, 0}, {1.4, 0.8}, {0.4, 0.8}}), true},
                    Shape{"trapezoid", flat({{0, 0}, {1.5, 0}, {1, 1}, {0, 1}}), false},
                    Shape{"kite", flat({{0, 0}, {1, -0.4}, {1.4, 0}, {1, 0.9}}), false},
                    Shape{"triangle", flat({{0, 0}, {1, 0}, {0.3, 0.9}}), false}),
    [](const auto& shape) { return shape.param.name; });

TEST(PatchSampler, KeepsInsideASliver) {
    const Sampled sliver(flat({{0, 0}, {1, 0}, {1, 0.125}, {0, 0.125}}));
    const double depth = sliver.depth(sliver.at(0.0f, 0.0f));
    EXPECT_GT(depth, 1e-7);  // a few steps of float
    EXPECT_LT(depth, 1e-5);
}

TEST(PatchSampler, HasARightHandedFrame) {
    const CutScene plate = cut(scene_of(moved(l_shape(), {1.0, Vec3::Zero(), odd_turn()})), 0.5);
    const RayScene rays(plate.scene, plate.lines.overlaps);
    const PatchSampler sampler = make_sampler(plate.mesh, 0, plate.scene.surfaces[0].normal, rays);
    EXPECT_LT((sampler.tangent.cross(sampler.bitangent) - sampler.normal).norm(), 1e-6f);
    EXPECT_LT((sampler.normal.cast<double>() - plate.scene.surfaces[0].normal).norm(), 1e-6);
}

}  // namespace
}  // namespace patchlight::patch_sampler_test
