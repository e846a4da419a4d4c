#include "solver/form_factors/exchange_matrix.h"

#include "solver/form_factors/ray_cast_engine.h"
#include "solver/form_factors/repair_closure.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace patchlight::exchange_matrix_test {
namespace {

constexpr double rounding = 1e-6;  // float entries

/// Tells what it is told to, and how often it was asked where light goes that meets no front.
class Scripted final : public FormFactorEngine {
  public:
    explicit Scripted(double factor, double variance = 0.0)
        : factor_(factor), variance_(variance) {}
    bool pairwise() const override { return true; }
    void row(PatchIndex i, FactorRow& row) const override {
        row.clear();
        if (i == 0) row.add(1, factor_, variance_, 1.0);
    }
    Outside outside(PatchIndex) const override {
        ++asked;
        return {0.0, 1.0 - factor_, 100};
    }
    mutable std::atomic<int> asked = 0;

  private:
    double factor_, variance_;
};

TEST(BuildExchange, MeasuresAreasInUnitsOfTheirMean) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    const CutScene plates =
        cut(scene_of({rectangle(Vec3::Zero(), x, y), rectangle(Vec3::UnitZ(), y, 3.0 * x)}), 9.0);
    const ExchangeMatrix matrix = exchange_of(Scripted(0.3), plates);
    EXPECT_NEAR(matrix.unit, 2.0, 1e-12);
    EXPECT_NEAR(matrix.area[0], 0.5, 1e-12);
    EXPECT_NEAR(matrix.area[1], 1.5, 1e-12);
    EXPECT_NEAR(entry(matrix, 0, 1), 0.15, rounding);
}

TEST(BuildExchange, AsksWhereLightGoesOnlyWhereARowDoesNotSayItAll) {
    const CutScene plates = cut(facing_squares(), 9.0);
    const Scripted closed(1.0), open(0.3), uncertain(1.0, 1e-4);
    exchange_of(closed, plates);
    const ExchangeMatrix matrix = exchange_of(open, plates);
    exchange_of(uncertain, plates);
    EXPECT_EQ(closed.asked, 0);
    EXPECT_EQ(open.asked, 2);
    EXPECT_EQ(uncertain.asked, 2);
    EXPECT_NEAR(matrix.escaped[0], 0.7, rounding);
    EXPECT_EQ(matrix.rays, 200u);
    EXPECT_NEAR(matrix.measured.closure_max, 0.0, rounding);
    EXPECT_NEAR(matrix.measured.row_sum_mean, 0.3, rounding);
}

TEST(BuildExchange, StopsWhenTold) {
    const CutScene plates = cut(room(), 0.1);  // 600 rows: several chunks
    const RayScene rays(plates.scene, plates.lines.overlaps);
    const RayCastEngine engine(plates.scene, plates.mesh, rays, 16, 1);
    int calls = 0;
    double last = 0.0;
    const ExchangeMatrix stopped =
        build_exchange(engine, plates.scene, plates.mesh, [&](double fraction) {
            EXPECT_GT(fraction, last);
            last = fraction;
            return ++calls < 3;
        });
    EXPECT_FALSE(stopped.complete);
    EXPECT_EQ(calls, 3);
    EXPECT_LT(last, 0.9);
    EXPECT_TRUE(exchange_of(engine, plates).complete);
}

TEST(BuildExchange, JoinsCountedRowsIntoOneSymmetricMatrix) {
    const EngineScene closed(room_with_box(), 0.25);
    const RayCastEngine engine(closed.cut.scene, closed.cut.mesh, closed.rays, 256, 1);
    const ExchangeMatrix matrix = exchange_of(engine, closed.cut);
    EXPECT_NEAR(matrix.measured.closure_max, 0.0, rounding);
    EXPECT_GT(matrix.measured.reciprocity_max, 0.0);  // counted from either end
    EXPECT_EQ(matrix.rays, 256u * closed.cut.mesh.size());
    for (PatchIndex i = 0; i < matrix.size(); ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            EXPECT_GT(matrix.column[k], i);
            EXPECT_LE(matrix.exchange[k], matrix.ceiling[k]);
            EXPECT_GT(matrix.variance[k], 0.0f);
        }
    EXPECT_EQ(measure_closure(matrix).reciprocity_max, 0.0);
}

TEST(BuildExchange, RepairKeepsAPairThatOnlyItsSmallEndSaw) {
    // The large square sends one ray in 8000 to the small one: all of its 1024 escape.
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    const CutScene squares = cut(
        scene_of({rectangle(Vec3::Zero(), x, y), rectangle(Vec3(0.5, 0.5, 5), 0.1 * y, 0.1 * x)}),
        9.0);
    const RayScene rays(squares.scene, squares.lines.overlaps);
    ExchangeMatrix matrix =
        exchange_of(RayCastEngine(squares.scene, squares.mesh, rays, 1024, 1), squares);
    ASSERT_EQ(matrix.escaped[0], 1.0);
    const double before = entry(matrix, 0, 1);
    ASSERT_GT(before, 0.0);
    repair_closure(matrix);
    EXPECT_NEAR(entry(matrix, 0, 1), before, 0.1 * before);
    EXPECT_NEAR(measure_closure(matrix).closure_max, 0.0, rounding);
}

}  // namespace
}  // namespace patchlight::exchange_matrix_test
