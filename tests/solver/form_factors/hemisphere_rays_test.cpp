#include "solver/form_factors/hemisphere_rays.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patchlight::hemisphere_rays_test {
namespace {

constexpr int rays = 4096;

/// A turned plate cut into quads and triangles, and its rays.
struct Plate {
    explicit Plate(std::uint64_t seed, int count = rays)
        : plate(cut(scene_of(moved(l_shape(), {2.0, Vec3(3, 1, 2), odd_turn()})), 0.7)),
          ray_scene(plate.scene, plate.lines.overlaps),
          hemisphere(plate.scene, plate.mesh, ray_scene, count, seed) {}

    template <typename Visit>
    void for_each_ray(PatchIndex i, const Visit& visit) const {
        RayBatch batch;
        for (int first = 0; first < hemisphere.count(); first += ray_batch) {
            const int count = hemisphere.fill(i, first, batch);
            for (int k = 0; k < count; ++k)
                visit(RayPoint(batch.ox[k], batch.oy[k], batch.oz[k]),
                      RayPoint(batch.dx[k], batch.dy[k], batch.dz[k]));
        }
    }

    CutScene plate;
    RayScene ray_scene;
    HemisphereRays hemisphere;
};

TEST(HemisphereRays, LeaveAsLightDoesByTheCosine) {
    const Plate plate(1);
    const RayPoint normal = plate.plate.scene.surfaces[0].normal.cast<float>();
    // Density 2 cos θ of cos θ: mean 2/3, variance 1/18. 4 sigma of independent rays: 1 in 16 000.
    const double sigma = std::sqrt(1.0 / 18.0 / rays);
    for (PatchIndex i = 0; i < plate.plate.mesh.size(); ++i) {
        double sum = 0.0;
        float least = 1.0f, off_unit = 0.0f;
        plate.for_each_ray(i, [&](const RayPoint&, const RayPoint& direction) {
            const float cosine = direction.dot(normal);
            sum += static_cast<double>(cosine);
            least = std::min(least, cosine);
            off_unit = std::max(off_unit, std::abs(direction.norm() - 1.0f));
        });
        EXPECT_NEAR(sum / rays, 2.0 / 3.0, 4 * sigma) << i;
        EXPECT_GT(least, 0.0f) << i;
        EXPECT_LT(off_unit, 1e-5f) << i;
    }
}

TEST(HemisphereRays, FavourNoSide) {
    const Plate plate(2);
    const PatchSampler& sampler = plate.hemisphere.sampler(0);
    std::array<int, 16> sectors{};
    plate.for_each_ray(0, [&](const RayPoint&, const RayPoint& direction) {
        const double turn =
            std::atan2(direction.dot(sampler.bitangent), direction.dot(sampler.tangent)) /
                6.2831854 +
            0.5;
        ++sectors[static_cast<std::size_t>(std::clamp(turn, 0.0, 0.99999) * 16)];
    });
    const double expected = rays / 16.0;
    for (const int count : sectors)
        EXPECT_NEAR(count, expected, 4 * std::sqrt(expected));  // binomial: 1 in 16 000 each
}

TEST(HemisphereRays, StartAtTheLiftAboveTheirPatch) {
    const Plate plate(3);
    const Surface& surface = plate.plate.scene.surfaces[0];
    const RayPoint normal = surface.normal.cast<float>(),
                   corner = plate.ray_scene.to_ray_space(surface.corners[0]);
    const float rounding = 3e-7f;  // float in ray space
    for (PatchIndex i = 0; i < plate.plate.mesh.size(); ++i) {
        RayPoint mean = RayPoint::Zero();
        plate.for_each_ray(i, [&](const RayPoint& origin, const RayPoint&) {
            EXPECT_NEAR((origin - corner).dot(normal), plate.ray_scene.lift(0), rounding);
            mean += origin / rays;
        });
        const RayPoint centre = plate.ray_scene.to_ray_space(plate.plate.mesh.patches[i].centre);
        const double size = plate.plate.mesh.patch_size * plate.ray_scene.scale();
        // Uniform over the patch: a deviation of at most 0.3 of its size for one ray; 4 sigma.
        EXPECT_LT((mean - centre).norm(), 4 * 0.3 * size / std::sqrt(rays)) << i;
    }
}

TEST(HemisphereRays, AreTheSameEachTimeAndOthersForAnotherSeedOrPatch) {
    const Plate plate(4), other(5);
    RayBatch once, again, of_other_seed, of_other_patch;
    plate.hemisphere.fill(0, 16, once);
    plate.hemisphere.fill(0, 16, again);
    other.hemisphere.fill(0, 16, of_other_seed);
    plate.hemisphere.fill(1, 16, of_other_patch);
    EXPECT_EQ(once.ox, again.ox);
    EXPECT_EQ(once.oz, again.oz);
    EXPECT_EQ(once.dx, again.dx);
    EXPECT_EQ(once.dy, again.dy);
    EXPECT_EQ(once.dz, again.dz);
    EXPECT_NE(once.dx, of_other_seed.dx);
    EXPECT_NE(once.dx, of_other_patch.dx);
}

TEST(HemisphereRays, TheLastBatchHoldsTheRest) {
    const Plate plate(1, 37);
    RayBatch batch;
    EXPECT_EQ(plate.hemisphere.count(), 37);
    EXPECT_EQ(plate.hemisphere.fill(0, 16, batch), 16);
    EXPECT_EQ(plate.hemisphere.fill(0, 32, batch), 5);
}

}  // namespace
}  // namespace patchlight::hemisphere_rays_test
