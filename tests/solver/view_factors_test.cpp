#include "solver/view_factors.h"

#include "solver/form_factors/unoccluded_exchange.h"
#include "solver/scene/input_error.h"
#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/view_factor_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::view_factors_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double closed = 1e-6;                               // largest closure defect after repair
constexpr double opposite = 0.1998249, adjacent = 0.2000438;  // walls of a cube: Howell C-11, C-14
constexpr double quadrature = 1e-6;

SolveSettings cut_to(double patch_size) {
    SolveSettings settings;
    settings.patch_size = patch_size;
    return settings;
}

/// All as faces of one object.
Scene as_one_object(Scene scene) {
    for (Surface& surface : scene.surfaces) {
        surface.face = surface.object;
        surface.object = 0;
    }
    scene.objects.resize(1);
    return scene;
}

/// Facing unit squares with half a square between them, seen by neither's neighbours.
Scene blocked_pair() {
    Scene scene = facing_squares();
    add(scene, rectangle(Vec3(0.25, 0.25, 0.5), 0.5 * Vec3::UnitX(), 0.5 * Vec3::UnitY()),
        two_sided);
    return scene;
}

/// The unit cube from within, with up to eight boxes that neither touch nor overlap.
Scene room_with_random_boxes(unsigned seed) {
    std::mt19937 chance(seed);
    Scene scene = room();
    for (int cell = 0; cell < 8; ++cell) {
        if (uniform(chance) < 0.4) continue;
        const Vec3 corner(0.5 * (cell % 2), 0.5 * (cell / 2 % 2), 0.5 * (cell / 4));
        const auto inside = [&]() -> Vec3 {
            return Vec3(uniform(chance), uniform(chance), uniform(chance)) * 0.2;
        };
        const Vec3 low = corner + Vec3::Constant(0.02) + inside();
        add_box(scene, low, low + Vec3::Constant(0.05) + inside(), Facing::outwards);
    }
    return scene;
}

/// A_i F_ij = A_j F_ji.
void expect_reciprocity(const ViewFactorTable& table) {
    for (std::size_t i = 0; i < table.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            ASSERT_NEAR(table.groups.areas[i] * table.factors[i][j],
                        table.groups.areas[j] * table.factors[j][i], rounding)
                << i << " " << j;
}

TEST(ViewFactors, OfACubesWallsAreHowells) {
    const ViewFactorTable table = view_factors(room(), cut_to(0.3), Grouping::object);
    ASSERT_EQ(table.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            const double exact = i == j ? 0.0 : i / 2 == j / 2 ? opposite : adjacent;
            EXPECT_NEAR(table.factors[i][j], exact, quadrature) << i << " " << j;
        }
        EXPECT_NEAR(table.row_sum(i), 1.0, closed);
    }
    EXPECT_EQ(table.report.form_factors.rays, 0u) << "nothing blocks anything";
    EXPECT_FALSE(table.report.form_factors.open);
    EXPECT_FALSE(table.report.streamed);
}

TEST(ViewFactors, OfTheSameWallsAsFacesOfOneObjectAreTheSame) {
    const Scene cube = as_one_object(room());
    const ViewFactorTable faces = view_factors(cube, cut_to(0.3), Grouping::face);
    const ViewFactorTable walls = view_factors(room(), cut_to(0.3), Grouping::object);
    EXPECT_EQ(faces.groups.names[5], "#0[5]");
    EXPECT_EQ(faces.factors, walls.factors);
    const ViewFactorTable object = view_factors(cube, cut_to(0.3), Grouping::object);
    ASSERT_EQ(object.size(), 1u);
    EXPECT_NEAR(object.factors[0][0], 1.0, closed) << "it sees nothing but itself";
}

TEST(ViewFactors, OfPatchesSumToThoseOfTheirObjects) {
    const Scene scene = room_with_box();
    const ViewFactorTable objects = view_factors(scene, cut_to(0.4), Grouping::object);
    const ViewFactorTable patches = view_factors(scene, cut_to(0.4), Grouping::patch);
    for (std::size_t from = 0; from < objects.size(); ++from)
        for (std::size_t to = 0; to < objects.size(); ++to) {
            double power = 0.0;
            for (const PatchIndex i : objects.groups.patches[from])
                for (const PatchIndex j : objects.groups.patches[to])
                    power += patches.groups.areas[i] * patches.factors[i][j];
            EXPECT_NEAR(power / objects.groups.areas[from], objects.factors[from][to], rounding);
        }
}

TEST(ViewFactors, OfATwoSidedFaceAreOfBothItsSides) {
    Scene scene = facing_squares();
    add(scene, rectangle(Vec3(0, 0, 0.5), Vec3::UnitX(), Vec3::UnitY()), two_sided);
    const ViewFactorTable table = view_factors(scene, cut_to(0.25), Grouping::face);
    const double half_a_metre = 0.4152533;  // Howell C-11: unit squares facing at distance 0.5
    EXPECT_NEAR(table.groups.areas[2], 2.0, rounding);
    EXPECT_NEAR(table.factors[0][2], half_a_metre, quadrature);
    EXPECT_NEAR(table.factors[2][0], 0.5 * half_a_metre, quadrature) << "by one of two sides";
    EXPECT_EQ(table.factors[2][2], 0.0) << "the sides do not see each other";
    EXPECT_EQ(table.factors[0][1], 0.0) << "it stands between them";
}

TEST(ViewFactors, OfAnObjectToItselfHaveTheErrorOfItsPairsMetTwice) {
    const ViewFactorTable apart = view_factors(blocked_pair(), cut_to(0.34), Grouping::object);
    Scene scene = blocked_pair();
    for (Surface& surface : scene.surfaces) surface.object = surface.object < 2 ? 0 : 1;
    scene.objects.resize(2);
    const ViewFactorTable joined = view_factors(scene, cut_to(0.34), Grouping::object);
    EXPECT_NEAR(joined.factors[0][0], apart.factors[0][1], rounding);
    ASSERT_GT(apart.errors[0][1], 1e-5);
    EXPECT_NEAR(joined.errors[0][0] / apart.errors[0][1], 1.0, 1e-6);
}

TEST(ViewFactors, OfAnOpenSceneAreNotNormalised) {
    const ViewFactorTable clear = view_factors(facing_squares(), cut_to(0.34), Grouping::object);
    EXPECT_NEAR(clear.row_sum(0), opposite, quadrature);
    EXPECT_TRUE(clear.report.form_factors.open);
    const ViewFactorTable blocked = view_factors(blocked_pair(), cut_to(0.34), Grouping::object);
    EXPECT_NEAR(blocked.factors[0][1], 0.09951, 4.0 * blocked.errors[0][1]);
    EXPECT_LT(blocked.row_sum(0), 0.24);
    EXPECT_TRUE(blocked.report.form_factors.open);
}

TEST(ViewFactors, OfRoomsWithBoxesObeyClosureAndReciprocity) {
    // Pairs of which all samples were blocked stay at 0, lest light cross walls: a row that needs
    // one of them to be closed stays open by as much.
    constexpr double nearly = 2e-3;
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        SolveSettings settings = cut_to(0.5);
        settings.rays = 1024;
        const Scene scene = room_with_random_boxes(seed);
        const ViewFactorTable table = view_factors(scene, settings, Grouping::object);
        for (std::size_t i = 0; i < table.size(); ++i)
            EXPECT_NEAR(table.row_sum(i), 1.0, nearly) << "seed " << seed << " object " << i;
        EXPECT_LE(table.report.form_factors.repaired.closure_max, nearly);
        EXPECT_GT(table.report.form_factors.measured.closure_max, closed) << "nothing to repair";
        expect_reciprocity(table);
    }
}

TEST(ViewFactors, NeverExceedWhatNothingBetweenWouldLeave) {
    constexpr double single = 1e-6;  // relative: the matrix is kept in single precision
    for (const unsigned seed : {5u, 6u, 7u, 8u}) {
        SolveSettings settings = cut_to(0.5);
        settings.rays = 16;  // so that the repair has much to do
        const CutScene scene = cut(room_with_random_boxes(seed), 0.5);
        const ViewFactorTable table = view_factors(scene.scene, settings, Grouping::patch);
        const UnoccludedExchange clear(scene.scene, scene.mesh, find_plane_groups(scene.scene));
        for (PatchIndex i = 0; i < table.size(); ++i)
            for (PatchIndex j = 0; j < table.size(); ++j) {
                const double most =
                    i == j ? 0.0 : clear(std::min(i, j), std::max(i, j)) / table.groups.areas[i];
                ASSERT_GE(table.factors[i][j], 0.0);
                ASSERT_LE(table.factors[i][j], std::min(1.0, most) * (1.0 + single));
            }
        expect_reciprocity(table);
    }
}

TEST(ViewFactors, ThatDoNotFitInMemoryAreStreamedAndAgree) {
    const Scene scene = room_with_box();
    SolveSettings kept = cut_to(0.05);
    kept.rays = 64;
    SolveSettings streamed = with_little_memory(scene, 0.05);
    streamed.rays = 64;
    const ViewFactorTable whole = view_factors(scene, kept, Grouping::object);
    const ViewFactorTable rows = view_factors(scene, streamed, Grouping::object);
    ASSERT_FALSE(whole.report.streamed);
    ASSERT_TRUE(rows.report.streamed);
    EXPECT_GT(rows.report.form_factors.rays, 0u);
    EXPECT_EQ(rows.report.form_factors.open, whole.report.form_factors.open);
    constexpr double deviations = 5.0;  // of both: false alarm below 1e-4 in all 144 comparisons
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool covered = whole.row_sum(i) < 0.95;  // the floor below the box, and its bottom
        if (!covered) {
            EXPECT_NEAR(rows.row_sum(i), 1.0, closed) << i;
        }
        EXPECT_NEAR(rows.row_sum(i), whole.row_sum(i), closed) << i;
        for (std::size_t j = 0; j < rows.size(); ++j)
            EXPECT_NEAR(rows.factors[i][j], whole.factors[i][j],
                        deviations * std::hypot(rows.errors[i][j], whole.errors[i][j]) + rounding)
                << i << " " << j;
    }
}

TEST(ViewFactors, AreTheSameFromAnyNumberOfThreads) {
    SolveSettings one = cut_to(0.34), three = one;
    one.threads = 1;
    three.threads = 3;
    const ViewFactorTable a = view_factors(room_with_box(), one, Grouping::patch);
    const ViewFactorTable b = view_factors(room_with_box(), three, Grouping::patch);
    EXPECT_EQ(a.factors, b.factors);
    EXPECT_EQ(a.errors, b.errors);
}

TEST(ViewFactors, OfNothingAreRefused) {
    EXPECT_THROW(ViewFactorSolver(empty_scene(), {}, Grouping::object), InputError);
    SolveSettings tiny = cut_to(0.1);
    tiny.memory_limit = 1000;
    EXPECT_THROW(ViewFactorSolver(room(), tiny, Grouping::object), InputError);
}

}  // namespace
}  // namespace patchlight::view_factors_test
