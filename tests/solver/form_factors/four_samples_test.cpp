#include "solver/form_factors/four_samples.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::four_samples_test {
namespace {

constexpr float rounding = 1e-6f;  // float in ray space, some operations

RayPoint origin_of(const RayBatch& batch, std::size_t k) {
    return {batch.ox[k], batch.oy[k], batch.oz[k]};
}
RayPoint segment_of(const RayBatch& batch, std::size_t k) {
    return {batch.dx[k], batch.dy[k], batch.dz[k]};
}

void expect_as_made_singly(const Polygon& p, const Polygon& q) {
    const CutScene both = cut(scene_of({p, q}), 99.0);
    const RayScene rays(both.scene, both.lines.overlaps);
    const PatchSampler from = make_sampler(both.mesh, 0, both.scene.surfaces[0].normal, rays),
                       to = make_sampler(both.mesh, 1, both.scene.surfaces[1].normal, rays);
    const PairEnds ends{
        from,        to, rays.lift(0) * from.normal, rays.lift(1) * to.normal, RayPoint::Zero(),
        {1, 2, 3, 4}};
    const SobolPoints points(64);
    RayBatch batch;
    std::array<float, ray_batch> weights;
    for (const int first : {0, 4, 32, 60}) {
        make_four_samples(ends, points, first, 8, batch, weights);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto u = [&](std::size_t d) {
                return points.at(d, static_cast<std::size_t>(first) + k, ends.seeds[d]);
            };
            const RayPoint x = from.at(u(0), u(1)) + ends.above_from,
                           y = to.at(u(2), u(3)) + ends.above_to;
            EXPECT_LT((origin_of(batch, 8 + k) - x).norm(), rounding);
            EXPECT_LT((segment_of(batch, 8 + k) - (y - x)).norm(), rounding);
            const float leaving = std::max(0.0f, (y - x).dot(from.normal)),
                        arriving = std::max(0.0f, (x - y).dot(to.normal));
            const float kernel = leaving * arriving / std::pow((y - x).squaredNorm(), 2.0f);
            EXPECT_NEAR(weights[8 + k], kernel, 1e-4f * kernel);
        }
    }
}

TEST(MakeFourSamples, AreThoseMadeSingly) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const Polygon square = rectangle(Vec3::Zero(), x, y);
    expect_as_made_singly(square, rectangle(z, y, x));
    expect_as_made_singly(square, {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1.5)});
    expect_as_made_singly(flat({{0, 0}, {1.5, 0}, {1, 1}, {0, 1}}), rectangle(-x - z, y, 2.0 * z));
}

TEST(MakeFourSamples, WeighNothingFromBehind) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    expect_as_made_singly(rectangle(Vec3::Zero(), x, y), rectangle(z, x, y));
    expect_as_made_singly(rectangle(Vec3::Zero(), y, x), rectangle(z, y, x));
}

}  // namespace
}  // namespace patchlight::four_samples_test
