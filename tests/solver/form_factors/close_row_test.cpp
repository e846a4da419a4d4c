#include "solver/form_factors/close_row.h"

#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

namespace patchlight::close_row_test {
namespace {

constexpr double rounding = 1e-12;

/// An engine of which only the light outside is asked for, and how often.
class OutsideOnly final : public FormFactorEngine {
  public:
    explicit OutsideOnly(const Outside& outside) : outside_(outside) {}
    bool pairwise() const override { return false; }
    void row(PatchIndex, FactorRow& row) const override { row.clear(); }
    Outside outside(PatchIndex) const override {
        ++asked;
        return outside_;
    }
    mutable int asked = 0;

  private:
    Outside outside_;
};

struct Entry {
    double factor, variance, ceiling = 1.0;
};
FactorRow row_with(const std::vector<Entry>& entries) {
    FactorRow row;
    for (const Entry& e : entries)
        row.add(static_cast<PatchIndex>(row.columns.size() + 1), e.factor, e.variance, e.ceiling);
    return row;
}

double closure(const FactorRow& row, const Outside& outside) {
    return row_sum(row) + outside.backs + outside.escaped;
}

TEST(CloseRow, SpreadsTheDeficitByVariance) {
    FactorRow row = row_with({{0.5, 0.0}, {0.2, 1e-4}, {0.2, 3e-4}});
    row.outside = Outside{0.0, 0.0, 1000};
    const OutsideOnly engine({});
    const Outside outside = close_row(engine, 0, row);
    EXPECT_EQ(row.factors[0], 0.5) << "exact";
    EXPECT_NEAR(row.factors[1], 0.225, rounding);
    EXPECT_NEAR(row.factors[2], 0.275, rounding);
    EXPECT_EQ(outside.escaped, 0.0) << "no ray escaped of a closed room";
    EXPECT_EQ(engine.asked, 0) << "the row says";
}

TEST(CloseRow, SharesASurplusWithTheLightOutside) {
    FactorRow row = row_with({{0.5, 1e-3}});
    row.outside = Outside{0.25, 0.27, 250};  // variances 7.5e-4 and 7.9e-4
    const Outside outside = close_row(OutsideOnly({}), 0, row);
    EXPECT_NEAR(closure(row, outside), 1.0, rounding);
    const double total = 1e-3 + 0.25 * 0.75 / 250 + 0.27 * 0.73 / 250;
    EXPECT_NEAR(row.factors[0], 0.5 - 0.02 * 1e-3 / total, rounding);
    EXPECT_LT(outside.backs, 0.25);
    EXPECT_LT(outside.escaped, 0.27);
}

TEST(CloseRow, KeepsASmallEntryThoughAllRaysEscaped) {
    const double factor = 1e-4, variance = 1e-10;
    FactorRow row = row_with({{factor, variance}});
    row.outside = Outside{0.0, 1.0, 1000};
    const Outside outside = close_row(OutsideOnly({}), 0, row);
    EXPECT_NEAR(closure(row, outside), 1.0, rounding);
    EXPECT_NEAR(row.factors[0], factor, 0.01 * factor);
}

TEST(CloseRow, GivesATinyPatchNoMoreThanItCanHave) {
    // One ray of a hundred met a patch that 1e-4 of the light fills.
    FactorRow row = row_with({{0.01, 1e-4, 1e-4}, {0.5, 2.5e-3}, {0.49, 2.5e-3}});
    row.outside = Outside{0.0, 0.0, 100};
    const Outside outside = close_row(OutsideOnly({}), 0, row);
    EXPECT_NEAR(closure(row, outside), 1.0, rounding);
    EXPECT_NEAR(row.factors[0], 1e-4, rounding);
    EXPECT_GT(row.factors[1], 0.5);
}

TEST(CloseRow, NeverRisesAboveACeilingNorFallsBelowNothing) {
    FactorRow row = row_with({{0.1, 9e-3, 0.12}, {0.3, 1e-3}, {0.3, 1e-3, 0.31}});
    row.outside = Outside{0.0, 0.0, 100};
    const Outside up = close_row(OutsideOnly({}), 0, row);
    EXPECT_NEAR(closure(row, up), 1.0, rounding);
    EXPECT_NEAR(row.factors[0], 0.12, rounding);
    EXPECT_NEAR(row.factors[1], 0.57, rounding) << "takes what the others cannot";
    EXPECT_NEAR(row.factors[2], 0.31, rounding);

    FactorRow over = row_with({{0.01, 9e-3}, {0.6, 1e-3}, {0.6, 0.0}});
    over.outside = Outside{0.0, 0.0, 100};
    const Outside down = close_row(OutsideOnly({}), 0, over);
    EXPECT_NEAR(closure(over, down), 1.0, rounding);
    EXPECT_EQ(over.factors[0], 0.0);
    EXPECT_NEAR(over.factors[1], 0.4, rounding);
}

TEST(CloseRow, LeavesAnExactRowThatSumsToOneAloneAndAsksNothing) {
    FactorRow row = row_with({{0.4, 0.0}, {0.6, 0.0}});
    const OutsideOnly engine({0.5, 0.5, 100});
    const Outside outside = close_row(engine, 0, row);
    EXPECT_EQ(row.factors, (std::vector<double>{0.4, 0.6}));
    EXPECT_EQ(engine.asked, 0);
    EXPECT_EQ(outside.backs + outside.escaped, 0.0);
}

TEST(CloseRow, OfAnExactOpenRowPutsTheRestOutside) {
    FactorRow row = row_with({{0.3, 0.0}});
    const OutsideOnly engine({0.2, 0.4, 100});
    const Outside outside = close_row(engine, 0, row);
    EXPECT_EQ(engine.asked, 1);
    EXPECT_EQ(row.factors[0], 0.3);
    EXPECT_NEAR(closure(row, outside), 1.0, rounding);
    EXPECT_GT(outside.escaped, 0.4);
    EXPECT_GT(outside.backs, 0.2);
    // 256 rays may all have missed the gap through which a little escapes.
    FactorRow nearly = row_with({{0.999, 0.0}});
    const Outside little = close_row(OutsideOnly({0.0, 0.0, 256}), 0, nearly);
    EXPECT_NEAR(little.escaped, 0.001, rounding);
}

TEST(CloseRow, OfAnUncertainRowAsksOnceWhereTheRestGoes) {
    FactorRow row = row_with({{0.3, 1e-3}, {0.4, 0.0}});
    const OutsideOnly engine({0.0, 0.25, 256});
    const Outside outside = close_row(engine, 0, row);
    EXPECT_EQ(engine.asked, 1);
    EXPECT_NEAR(closure(row, outside), 1.0, rounding);
    EXPECT_NEAR(row.factors[0] - 0.3, 0.05 * 1e-3 / (1e-3 + 0.25 * 0.75 / 256), rounding);
}

TEST(CloseRow, OfNothingButBacksStaysThatWay) {
    FactorRow row;  // as of a covered patch
    row.outside = Outside{1.0, 0.0, 0};
    const Outside outside = close_row(OutsideOnly({}), 0, row);
    EXPECT_EQ(outside.backs, 1.0);
    EXPECT_EQ(outside.escaped, 0.0);
    EXPECT_TRUE(row.factors.empty());
}

}  // namespace
}  // namespace patchlight::close_row_test
