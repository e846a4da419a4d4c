#include "solver/hierarchy/cluster_exchange.h"

#include "solver/accuracy/cluster_transport.h"
#include "solver/transport/patch_fields.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>
#include <numbers>

namespace patchlight::cluster_exchange_test {
namespace {

constexpr int rays = 4096;

/// The inside of a ball of triangles.
Scene hollow_ball(int slices) {
    Scene scene = empty_scene();
    const auto at = [&](int i, int j) {
        const double theta = std::numbers::pi * i / slices,
                     phi = 2.0 * std::numbers::pi * j / (2 * slices);
        return Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                    std::cos(theta));
    };
    for (int i = 0; i < slices; ++i)
        for (int j = 0; j < 2 * slices; ++j) {
            const Vec3 a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
            if (i > 0) add(scene, {a, b, c});
            if (i + 1 < slices) add(scene, {a, c, d});
        }
    return scene;
}

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct Ball {
    CutScene pieces = cut(hollow_ball(24), 1.0);
    RayScene ray_scene{pieces.scene, pieces.lines.overlaps};
    LightClusters clusters = make_light_clusters(pieces.scene, pieces.mesh, 40);
    ClusterExchange exchange =
        find_cluster_exchange(pieces.scene, pieces.mesh, ray_scene, clusters, rays, no_limit, 1,
                              [](double) { return true; });
};

/// In a ball every point sees every other alike: a cluster sends to each, and to itself, in
/// proportion to its area. Four standard errors of both ends' rays, and half a per cent for flat
/// triangles: a false alarm in 16,000 pairs, of which there are 820; the seed is fixed.
TEST(ClusterExchange, SendsToAllAlikeInABall) {
    const Ball ball;
    const ExchangeMatrix& between = ball.exchange.between;
    double whole = 0.0;
    for (const double area : ball.clusters.area) whole += area;
    const auto expect_share = [&](double found, double expected, double samples) {
        const double error = std::sqrt(expected * (1.0 - expected) / samples);
        EXPECT_NEAR(found, expected, 4.0 * error + 0.005 * expected);
    };
    for (PatchIndex c = 0; c < ball.clusters.size(); ++c) {
        expect_share(ball.exchange.within[c], ball.clusters.area[c] / whole, rays);
        for (std::size_t k = between.start[c]; k < between.start[c + 1]; ++k) {
            const PatchIndex d = between.column[k];
            expect_share(static_cast<double>(between.exchange[k]) / between.area[c],
                         ball.clusters.area[d] / whole, rays);
        }
    }
}

TEST(ClusterExchange, ClosesEachRow) {
    const Ball ball;
    const ExchangeMatrix& between = ball.exchange.between;
    std::vector<double> sums = ball.exchange.within;
    for (PatchIndex c = 0; c < ball.clusters.size(); ++c) {
        sums[c] += between.backs[c] + between.escaped[c];
        for (std::size_t k = between.start[c]; k < between.start[c + 1]; ++k) {
            const auto h = static_cast<double>(between.exchange[k]);
            sums[c] += h / between.area[c];
            sums[between.column[k]] += h / between.area[between.column[k]];
        }
    }
    for (const double sum : sums) EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(ClusterExchange, StopsWhenToldTo) {
    Ball ball;
    const ClusterExchange stopped =
        find_cluster_exchange(ball.pieces.scene, ball.pieces.mesh, ball.ray_scene, ball.clusters,
                              64, no_limit, 1, [](double) { return false; });
    EXPECT_FALSE(stopped.between.complete);
}

TEST(ClusterExchange, CastsFewerRaysWhereThereIsNoTimeForAll) {
    const Ball ball;
    const ClusterExchange hurried =
        find_cluster_exchange(ball.pieces.scene, ball.pieces.mesh, ball.ray_scene, ball.clusters,
                              rays, 1e-9, 1, [](double) { return true; });
    EXPECT_TRUE(hurried.between.complete);
    EXPECT_LT(hurried.between.rays, ball.exchange.between.rays / 4);
    EXPECT_GE(hurried.between.rays, 16 * ball.clusters.size());
}

/// B = E / (1 - ρ) where light is given off alike all over a closed scene, whatever the clusters:
/// only closure counts.
TEST(ClusterTransport, KeepsAllLightInABall) {
    const Ball ball;
    const PatchFields fields = make_patch_fields(ball.pieces.scene, ball.pieces.mesh);
    const ClusterTransport transport(ball.clusters, ball.exchange, fields.area, fields.reflectance);
    const Field exitance(1, std::vector<double>(ball.pieces.mesh.size(), 1.0));
    const Transported found = transport.solve(exitance, 1e-6, {});
    const double expected = 1.0 / (1.0 - fields.reflectance[0][0]);
    for (PatchIndex i = 0; i < ball.pieces.mesh.size(); ++i) {
        EXPECT_NEAR(found.radiosity[0][i], expected, 1e-3 * expected);
        EXPECT_NEAR(found.irradiance[0][i], expected, 1e-3 * expected);
    }
}

/// Of light given off by one patch alone, too, all goes on: the field after one bounce is alike
/// everywhere, and it sums to what was sent.
TEST(ClusterTransport, SendsOnWhatOnePatchGivesOff) {
    const Ball ball;
    const PatchFields fields = make_patch_fields(ball.pieces.scene, ball.pieces.mesh);
    const ClusterTransport transport(ball.clusters, ball.exchange, fields.area, fields.reflectance);
    Field exitance(1, std::vector<double>(ball.pieces.mesh.size(), 0.0));
    const PatchIndex from = 100;
    exitance[0][from] = 1.0;
    const Field once = *transport.once(exitance);
    double arrived = 0.0;
    for (PatchIndex i = 0; i < ball.pieces.mesh.size(); ++i) arrived += fields.area[i] * once[0][i];
    EXPECT_NEAR(arrived, fields.area[from], 1e-5 * fields.area[from]);
}

}  // namespace
}  // namespace patchlight::cluster_exchange_test
