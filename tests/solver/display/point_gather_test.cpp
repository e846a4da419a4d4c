#include "solver/display/point_gather.h"

#include "solver/form_factors/point_factor.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace patchlight::point_gather_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// Rays read `radiosity` of patches, constant over each.
struct Reader {
    CutScene pieces;
    RayScene rays;
    PatchLocator locator;
    std::optional<ReflectedField> field;
    PointGather gather;

    Reader(const Scene& scene, double patch_size, const std::function<double(const Vec3&)>& bright,
           std::size_t most_sources = 100)
        : pieces(cut(scene, patch_size)),
          rays(pieces.scene, pieces.lines.overlaps),
          locator(pieces.scene, pieces.mesh, rays),
          gather(rays, find_light_sources(pieces.scene, pieces.lines, rays, most_sources),
                 1 << 14) {
        FieldTable table(pieces.mesh, {}, rays, {});
        for (PatchIndex i = 0; i < pieces.mesh.size(); ++i)
            table.add_linear(i, Rgb::Constant(bright(pieces.mesh.patches[i].centre)),
                             Eigen::Matrix3d::Zero());
        field.emplace(pieces.scene, pieces.mesh, rays, locator, std::move(table));
    }
    GatherPoint at(const Vec3& position, const Vec3& normal) const {
        return gather.at(position, normal, rays.contact(), 0);
    }
};

Scene under_lamp(bool half_covered) {
    Scene scene = empty_scene();
    add(scene, rectangle({0, 0, 0}, x, y));
    add(scene, rectangle({0, 1, 1}, x, -y), lamp);
    if (half_covered) add(scene, rectangle({-1, 0.5, 0.9}, 3 * x, -2 * y), two_sided);
    return scene;
}

TEST(PointGather, MeetsLambertsFormulaWhereNothingBlocks) {
    const Reader reader(under_lamp(false), 1.0, [](const Vec3&) { return 0.0; });
    // A unit square, seen from below its centre at distance 1.
    const double a = 0.5 / std::sqrt(1.25), b = std::atan(0.5 / std::sqrt(1.25));
    const double exact = 4.0 * a * b / M_PI;
    const Rgb found = reader.gather.direct(reader.at({0.5, 0.5, 0}, z), {16, 256}, 1).irradiance;
    EXPECT_NEAR(found[0], exact, 1e-9);
}

TEST(PointGather, SeesHalfALampBehindAnEdge) {
    const Reader reader(under_lamp(true), 1.0, [](const Vec3&) { return 0.0; });
    const Rgb whole =
        reader.gather.direct(reader.at({0.5, 0.5, 0.95}, z), {16, 4096}, 1).irradiance;
    EXPECT_GT(whole[0], 0.5) << "above the cover";
    const double a = 0.5 / std::sqrt(1.25), b = std::atan(0.5 / std::sqrt(1.25));
    const double half = 2.0 * a * b / M_PI;
    // The edge at y = 0.5, 0.9 up, is seen along the lamp's middle line from right below it.
    const Rgb found = reader.gather.direct(reader.at({0.5, 0.5, 0}, z), {16, 4096}, 1).irradiance;
    EXPECT_NEAR(found[0], half, 0.005 * half) << "4096 samples, one discontinuity";
}

/// Of a lamp of which 4 % are seen, 16 samples see nothing in about half of all places.
TEST(PointGather, WhatIsTooBrightToBeMissedIsSampledMore) {
    Scene scene = empty_scene();
    add(scene, rectangle({0, 0, 0}, x, y));
    add(scene, rectangle({0, 1, 1}, x, -y), lamp);
    add(scene, rectangle({-1, 0.96, 0.999}, 3 * x, -2 * y), two_sided);
    const Reader reader(scene, 1.0, [](const Vec3&) { return 0.0; });
    const auto unseen = [&](double bright) {
        int count = 0;
        for (std::uint64_t key = 0; key < 200; ++key) {
            const auto found =
                reader.gather.direct(reader.at({0.5, 0.5, 0}, z), {16, 1024, bright}, key);
            count += !(found.irradiance[0] > 0.0);
        }
        return count;
    };
    EXPECT_GT(unseen(1e9), 20);
    EXPECT_EQ(unseen(0.2394 / 16.0), 0) << "a sixteenth of all that the lamp gives: 128 samples";
}

/// The lamp in squares, with or without the cover.
Scene under_squares(int squares, bool half_covered) {
    Scene scene = empty_scene();
    add(scene, rectangle({0, 0, 0}, x, y));
    const double a = 1.0 / squares;
    for (int k = 0; k < squares * squares; ++k)
        add(scene, rectangle({k % squares * a, k / squares * a + a, 1}, a * x, -a * y), lamp);
    if (half_covered) add(scene, rectangle({-1, 0.5, 0.9}, 3 * x, -2 * y), two_sided);
    return scene;
}

TEST(PointGather, ManyLampsGiveWhatOneOfTheSameOutlineGives) {
    const double a = 0.5 / std::sqrt(1.25), b = std::atan(0.5 / std::sqrt(1.25));
    const double exact = 4.0 * a * b / M_PI;
    const Reader clear(under_squares(9, false), 1.0, [](const Vec3&) { return 0.0; });
    ASSERT_EQ(clear.gather.sources().size(), 81u);
    const auto whole = clear.gather.direct(clear.at({0.5, 0.5, 0}, z), {16, 256}, 1);
    EXPECT_NEAR(whole.irradiance[0], exact, 1e-9) << "exact where all samples are clear";
    EXPECT_EQ(whole.variance, 0.0);
    const Reader half(under_squares(9, true), 1.0, [](const Vec3&) { return 0.0; });
    double variance = 0.0, square = 0.0;
    constexpr int runs = 64;
    for (std::uint64_t key = 0; key < runs; ++key) {
        const auto found = half.gather.direct(half.at({0.5, 0.5, 0}, z), {16, 1024}, key);
        variance += found.variance / runs;
        square += std::pow(found.irradiance[0] - exact / 2.0, 2) / runs;
    }
    EXPECT_LT(std::sqrt(square), 0.02 * exact);
    // Of 64 squares each a ratio beyond 3 is no chance (false alarm below 1e-4).
    EXPECT_GT(variance, square / 3.0) << "what the halves say is no less than the noise";
}

TEST(PointGather, OfVeryManyLampsThoseFarOffCountAsPoints) {
    const double a = 0.5 / std::sqrt(1.25), b = std::atan(0.5 / std::sqrt(1.25));
    const double exact = 4.0 * a * b / M_PI;
    const Reader reader(
        under_squares(20, false), 1.0, [](const Vec3&) { return 0.0; }, 1000);
    ASSERT_EQ(reader.gather.sources().size(), 400u);
    DirectEffort effort{16, 256};
    const auto direct = [&] {
        return reader.gather.direct(reader.at({0.5, 0.5, 0}, z), effort, 1).irradiance[0];
    };
    effort.alike = 1e-6;
    EXPECT_NEAR(direct(), exact, 1e-9) << "none is far off for so little";
    effort.alike = 0.02;
    EXPECT_NEAR(direct(), exact, 0.002 * exact) << "a square's (radius / distance)² is 0.00125";
    EXPECT_GT(std::abs(direct() - exact), 1e-9);
}

TEST(PointGather, TakesTheMeanOfARoomOfOneBrightness) {
    const Reader reader(room(), 0.5, [](const Vec3&) { return 2.0; });
    for (const Vec3& at : {Vec3(0.5, 0.5, 0), Vec3(0.01, 0.01, 0), Vec3(0.9, 0.2, 0)}) {
        const auto found = reader.gather.indirect(reader.at(at, z), *reader.field, 256, 7);
        EXPECT_NEAR(found.irradiance[0], 2.0, 1e-4);
        EXPECT_NEAR(found.half_difference[0], 0.0, 1e-4);
    }
}

double spot(const Vec3& centre) {
    const bool is_lit = centre.z() > 0.99 && (centre - Vec3(0.55, 0.55, 1)).norm() < 0.1;
    return is_lit ? 100.0 : 0.1;
}

TEST(PointGather, SamplesWhatIsMuchBrighterLikeALamp) {
    const Reader reader(room(), 0.1, spot);
    ASSERT_TRUE(reader.field->has_excess());
    const GatherPoint point = reader.at({0.3, 0.4, 0}, z);
    const Rgb exact = reader.gather.indirect(point, *reader.field, 1 << 14, 3).irradiance;
    // With rays alone 256 of them would miss by 10 %: some 4 in 256 meet the spot.
    for (std::uint64_t key = 0; key < 16; ++key) {
        const auto found = reader.gather.indirect(point, *reader.field, 256, 100 + key);
        EXPECT_NEAR(found.irradiance[0], exact[0], 0.03 * exact[0]);
    }
}

/// Facets that meet at a point, some degrees either way of their mean normal.
std::vector<Vec3> facets(double degrees) {
    const double t = std::tan(degrees * M_PI / 180.0);
    return {Vec3(t, 0, 1).normalized(), Vec3(-t, 0, 1).normalized(), Vec3(0, t, 1).normalized(),
            Vec3(0, -t, 1).normalized()};
}

TEST(PointGather, FacetsThatShareRaysSeeARoomOfOneBrightnessAsItIs) {
    const Reader reader(room(), 0.5, [](const Vec3&) { return 2.0; });
    const std::vector<Vec3> normals = facets(15.0);
    std::vector<PointGather::Indirect> found(normals.size());
    reader.gather.indirect(reader.at({0.5, 0.4, 0.3}, z), normals, *reader.field, 0, 256, 7, found);
    for (const PointGather::Indirect& one : found) EXPECT_NEAR(one.irradiance[0], 2.0, 1e-4);
}

/// With a bright spot, sampled like a lamp, and without. 16,384 rays of either way leave less than
/// 0.3 %; what comes from between the planes, (1 - cosine) / 2 of it, is 0.4 % at 10 degrees.
TEST(PointGather, FacetsThatShareRaysGetWhatEachGetsByItself) {
    for (const auto& bright : {std::function<double(const Vec3&)>(spot),
                               std::function<double(const Vec3&)>(
                                   [](const Vec3& p) { return 1.0 + p.x() + 2.0 * p.z(); })}) {
        const Reader reader(room(), 0.1, bright);
        const Vec3 at(0.4, 0.45, 0.2);
        const std::vector<Vec3> normals = facets(10.0);
        std::vector<PointGather::Indirect> found(normals.size());
        reader.gather.indirect(reader.at(at, z), normals, *reader.field, 0, 1 << 14, 7, found);
        for (std::size_t k = 0; k < normals.size(); ++k) {
            const Rgb alone =
                reader.gather.indirect(reader.at(at, normals[k]), *reader.field, 1 << 14, 3)
                    .irradiance;
            EXPECT_NEAR(found[k].irradiance[0], alone[0], 0.01 * alone[0]) << k;
        }
    }
}

TEST(PointGather, TheExcessAddsNothingAndTakesNothingAway) {
    // The same patches read once with an excess and once as light of rays alone, at a point where
    // many rays meet it: both means must agree.
    const auto near_spot = [](const Vec3& centre) {
        return centre.z() > 0.99 && centre.x() < 0.5 ? 50.0 : 1.0;
    };
    const Reader reader(room(), 0.25, near_spot);
    const GatherPoint point = reader.at({0.0, 0.4, 0.9}, x);
    double mean = 0.0;
    constexpr int runs = 16;
    for (std::uint64_t key = 0; key < runs; ++key)
        mean += reader.gather.indirect(point, *reader.field, 1 << 12, key).irradiance[0] / runs;
    // By Lambert's formula: the lit half of the ceiling, and 1 from everywhere else.
    ConvexPolygon lit;
    for (const Vec3& p : {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(0.5, 1, 1), Vec3(0.5, 0, 1)})
        lit.add(p);
    const double factor = point_factor({0.0, 0.4, 0.9}, x, lit, -z);
    EXPECT_NEAR(mean, 1.0 + 49.0 * factor, 0.003 * mean);
}

TEST(PointGather, RaysThatAreJoinedMakeOneSequence) {
    const Reader reader(room(), 0.1, spot);
    ASSERT_TRUE(reader.field->has_excess());
    const GatherPoint point = reader.at({0.3, 0.4, 0}, z);
    const Rgb first = reader.gather.indirect(point, *reader.field, 0, 96, 5).irradiance,
              more = reader.gather.indirect(point, *reader.field, 96, 256, 5).irradiance,
              whole = reader.gather.indirect(point, *reader.field, 256, 5).irradiance;
    EXPECT_NEAR((96.0 * first[0] + 160.0 * more[0]) / 256.0, whole[0], 1e-6 * whole[0]);
    EXPECT_GT(std::abs(first[0] - more[0]), 1e-6) << "other rays";
}

TEST(PointGather, VarianceOfTheHalvesTellsTheNoise) {
    const Reader reader(room(), 0.1, [](const Vec3& c) {
        return 1.0 + (c.x() > 0.5 ? 1.0 : 0.0) + (c.z() > 0.5 ? 0.7 : 0.0);
    });
    const GatherPoint point = reader.at({0.45, 0.4, 0}, z);
    const Rgb exact = reader.gather.indirect(point, *reader.field, 1 << 14, 3).irradiance;
    double told = 0.0, found = 0.0;
    constexpr int runs = 400;
    for (std::uint64_t key = 0; key < runs; ++key) {
        const auto one = reader.gather.indirect(point, *reader.field, 128, 1000 + key);
        told += one.variance(Rgb::Ones()) / runs;
        found += std::pow(one.irradiance[0] - exact[0], 2) / runs;
    }
    EXPECT_GT(told, 0.4 * found);
    EXPECT_LT(told, 2.5 * found);
}

}  // namespace
}  // namespace patchlight::point_gather_test
