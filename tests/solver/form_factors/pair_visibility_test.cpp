#include "solver/form_factors/pair_visibility.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace patchlight::pair_visibility_test {
namespace {

constexpr int samples = 1024;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// Facing unit squares, patches 0 and 1, with a screen half-way between them.
struct Facing {
    explicit Facing(const std::optional<Polygon>& screen, std::uint64_t seed = 1)
        : plates(cut(with(screen), 1e9)),
          ray_scene(plates.scene, plates.lines.overlaps),
          hemisphere(plates.scene, plates.mesh, ray_scene, 16, 1),
          visibility(hemisphere, ray_scene, samples, seed) {}

    static Scene with(const std::optional<Polygon>& screen) {
        Scene scene = scene_of({rectangle(Vec3::Zero(), x, y), rectangle(z, y, x)});
        if (screen) add(scene, *screen);
        return scene;
    }
    VisibilityQuery ask(PatchIndex i, PatchIndex j, int first, int count) const {
        std::vector<VisibilityQuery> queries(1);
        queries[0].i = i, queries[0].j = j;
        queries[0].first = first, queries[0].count = count;
        visibility.measure(queries);
        return queries[0];
    }

    CutScene plates;
    RayScene ray_scene;
    HemisphereRays hemisphere;
    PairVisibility visibility;
};

Polygon screen(double from, double to) {
    return rectangle(Vec3(from, -1, 0.5), (to - from) * x, 3.0 * y);
}

TEST(PairVisibility, IsWholeWhereNothingBlocks) {
    const VisibilityQuery query = Facing(std::nullopt).ask(0, 1, 0, samples);
    EXPECT_EQ(query.visibility(), 1.0);
    EXPECT_EQ(query.taken, samples);
    EXPECT_EQ(query.clear, samples);
    EXPECT_GT(query.variance(), 0.0);
    EXPECT_LT(query.variance(), 2.0 / (samples * samples));  // "all of n agree": known to 1 / n
}

TEST(PairVisibility, IsNothingBehindAScreen) {
    const VisibilityQuery query = Facing(screen(-1, 2)).ask(0, 1, 0, samples);
    EXPECT_EQ(query.visibility(), 0.0);
    EXPECT_EQ(query.clear, 0);
    EXPECT_GT(query.variance(), 0.0);
}

TEST(PairVisibility, AScreenAcrossHalfTheWayTakesHalf) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const VisibilityQuery query = Facing(screen(-1, 0.5), seed).ask(0, 1, 0, samples);
        // 4.5 sigma of independent samples; twenty seeds: 1 in 7000 sound samplers fail.
        EXPECT_NEAR(query.visibility(), 0.5, 4.5 * std::sqrt(query.variance())) << seed;
        EXPECT_LT(std::sqrt(query.variance()), 0.6 / std::sqrt(samples) * 1.5) << seed;
    }
}

TEST(PairVisibility, AgreesFromBothEnds) {
    const Facing facing(screen(-1, 0.4));
    const VisibilityQuery forth = facing.ask(0, 1, 0, samples), back = facing.ask(1, 0, 0, samples);
    // Two independent estimates, 5 sigma of their difference: 1 in 1 700 000.
    EXPECT_NEAR(forth.visibility(), back.visibility(), 5.0 * std::sqrt(2.0 * forth.variance()));
}

TEST(PairVisibility, ScramblesAnewWhereItsPointsEnd) {
    const Facing facing(screen(-1, 0.4));
    const VisibilityQuery one = facing.ask(0, 1, 0, samples),
                          next = facing.ask(0, 1, samples, samples);
    EXPECT_EQ(next.taken, samples);
    EXPECT_NE(one.clear_weight, next.clear_weight);
    EXPECT_NEAR(one.visibility(), next.visibility(), 5.0 * std::sqrt(2.0 * one.variance()));
}

TEST(PairVisibility, CanBeMeasuredInParts) {
    const Facing facing(screen(-1, 0.4));
    std::vector<VisibilityQuery> queries(1);
    queries[0].i = 0, queries[0].j = 1;
    for (const auto& [first, count] : {std::pair(0, 100), {100, 28}, {128, samples - 128}}) {
        queries[0].first = first, queries[0].count = count;
        facing.visibility.measure(queries);
    }
    const VisibilityQuery whole = facing.ask(0, 1, 0, samples);
    EXPECT_EQ(queries[0].taken, whole.taken);
    EXPECT_EQ(queries[0].clear, whole.clear);
    EXPECT_EQ(queries[0].clear_weight, whole.clear_weight);
}

TEST(PairVisibility, QueriesInOneGoDoNotDisturbEachOther) {
    const Facing facing(screen(-1, 0.4));
    std::vector<VisibilityQuery> queries(3);
    for (VisibilityQuery& query : queries) query.i = 0, query.j = 1, query.count = 36;
    facing.visibility.measure(queries);
    const VisibilityQuery alone = facing.ask(0, 1, 0, 36);
    for (const VisibilityQuery& query : queries) {
        EXPECT_EQ(query.clear, alone.clear);
        EXPECT_EQ(query.weight, alone.weight);
    }
}

TEST(PairVisibility, OfPatchesThatDoNotFaceTakesNoSamples) {
    Scene scene = scene_of({rectangle(Vec3::Zero(), x, y), rectangle(z, x, y)});
    const CutScene plates = cut(scene, 9.0);
    const RayScene ray_scene(plates.scene, plates.lines.overlaps);
    const HemisphereRays hemisphere(plates.scene, plates.mesh, ray_scene, 16, 1);
    std::vector<VisibilityQuery> queries(1);
    queries[0].i = 0, queries[0].j = 1, queries[0].count = 64;
    PairVisibility(hemisphere, ray_scene, 64, 1).measure(queries);
    EXPECT_EQ(queries[0].taken, 0);
    EXPECT_EQ(queries[0].visibility(), 0.0);
}

TEST(VisibilityQuery, OneHeavySampleCountsForLittleMoreThanOne) {
    VisibilityQuery query;
    query.taken = 100, query.clear = 50;
    query.weight = 100.0f, query.clear_weight = 50.0f, query.weight_squared = 100.0f;
    const double even = query.variance();
    query.weight_squared = 9000.0f;  // nearly all of the weight on one
    EXPECT_GT(query.variance(), 20 * even);
    EXPECT_NEAR(even, 0.25 / 101, 1e-9);
}

}  // namespace
}  // namespace patchlight::pair_visibility_test
