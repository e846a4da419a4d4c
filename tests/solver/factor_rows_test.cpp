#include "solver/factor_rows.h"

#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/transport/row_engines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight::factor_rows_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double single = 1e-7;  // relative: what a matrix keeps is in single precision

/// A row as it was handed out.
struct Taken {
    PatchIndex i = 0;
    std::vector<PatchIndex> columns;
    std::vector<double> factors, variance;
};
std::vector<Taken> taken_from(FactorRows& rows, const std::vector<PatchIndex>& patches) {
    std::vector<Taken> taken;
    rows.visit(patches, [&](const FactorRowView& row) {
        taken.push_back({row.i,
                         {row.columns.begin(), row.columns.end()},
                         {row.factors.begin(), row.factors.end()},
                         {row.variance.begin(), row.variance.end()}});
        return true;
    });
    return taken;
}

std::vector<PatchIndex> first_patches(std::size_t n) {
    std::vector<PatchIndex> patches(n);
    std::iota(patches.begin(), patches.end(), 0u);
    return patches;
}

PatchMesh mesh_of(const std::vector<double>& areas) {
    PatchMesh mesh;
    for (const double area : areas) {
        mesh.patches.emplace_back();
        mesh.patches.back().area = area;
    }
    return mesh;
}

/// Sees the rows of a matrix through rays that lose `lost` of each, and says nothing of the rest.
class LossyEngine final : public FormFactorEngine {
  public:
    LossyEngine(std::vector<std::vector<double>> factors, double lost)
        : factors_(std::move(factors)), lost_(lost) {}
    bool pairwise() const override { return false; }
    void row(PatchIndex i, FactorRow& row) const override {
        row.clear();
        for (PatchIndex j = 0; j < factors_.size(); ++j)
            if (factors_[i][j] > 0.0) row.add(j, (1.0 - lost_) * factors_[i][j], 1e-4, 1.0);
        row.rays = 10;
    }
    Outside outside(PatchIndex) const override { return {0.0, 0.0, 100}; }

  private:
    std::vector<std::vector<double>> factors_;
    double lost_;
};

TEST(KeptRows, AreWholeRowsOutOfTheUpperTriangle) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        ExchangeMatrix matrix = random_closed(12, 0.4, seed);
        for (std::size_t k = 0; k < matrix.variance.size(); ++k)
            matrix.variance[k] = 1e-4f * static_cast<float>(k);
        const ExchangeMatrix dense = matrix;
        KeptRows rows(std::move(matrix));
        for (const Taken& row : taken_from(rows, first_patches(dense.size()))) {
            ASSERT_TRUE(std::is_sorted(row.columns.begin(), row.columns.end()));
            std::size_t k = 0;
            for (PatchIndex j = 0; j < dense.size(); ++j) {
                const double exchange = j == row.i ? 0.0 : entry(dense, row.i, j);
                if (exchange == 0.0) continue;
                ASSERT_LT(k, row.columns.size());
                EXPECT_EQ(row.columns[k], j);
                EXPECT_NEAR(row.factors[k], exchange / dense.area[row.i], rounding);
                ++k;
            }
            EXPECT_EQ(k, row.columns.size());
            const double sum = std::accumulate(row.factors.begin(), row.factors.end(), 0.0);
            EXPECT_NEAR(sum, 1.0, 12 * single);
        }
    }
}

TEST(KeptRows, TellOneErrorFromBothEnds) {
    ExchangeMatrix matrix = empty_matrix({1.0, 4.0, 2.0});
    add_entry(matrix, 0, 1, 0.5, 0.04);
    add_entry(matrix, 1, 2, 0.25, 0.01);
    finish(matrix);
    KeptRows rows(std::move(matrix));
    const std::vector<Taken> taken = taken_from(rows, {0, 1, 2});
    EXPECT_NEAR(taken[0].variance[0], 0.04, single);
    EXPECT_EQ(taken[1].columns, (std::vector<PatchIndex>{0, 2}));
    EXPECT_NEAR(taken[1].variance[0], 0.04 / 16.0, single);
    EXPECT_NEAR(taken[1].variance[1], 0.01 / 16.0, single);
    EXPECT_NEAR(taken[2].factors[0], 0.125, single);
}

TEST(KeptRows, ComeInTheOrderThatIsAskedFor) {
    KeptRows rows(random_closed(9, 0.5, 4));
    const std::vector<PatchIndex> wanted{7, 0, 7, 3};
    const std::vector<Taken> taken = taken_from(rows, wanted);
    ASSERT_EQ(taken.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(taken[k].i, wanted[k]);
    EXPECT_EQ(taken[0].factors, taken[2].factors);
}

TEST(KeptRows, OfWhatSeesNothingAreEmpty) {
    ExchangeMatrix matrix = empty_matrix({1.0, 1.0, 1.0});
    add_entry(matrix, 0, 2, 0.5);
    finish(matrix);
    KeptRows rows(std::move(matrix));
    EXPECT_TRUE(taken_from(rows, {1})[0].columns.empty());
}

TEST(StreamedRows, AreThoseOfTheEngineInTheOrderAskedFor) {
    constexpr std::size_t n = 100;  // several times as many as are computed at a time
    const MatrixEngine engine(random_rows(n, 0.5, 1));
    const PatchMesh mesh = mesh_of(std::vector<double>(n, 1.0));
    StreamedRows rows(engine, mesh);
    std::vector<PatchIndex> backwards = first_patches(n);
    std::reverse(backwards.begin(), backwards.end());
    const std::vector<Taken> taken = taken_from(rows, backwards);
    ASSERT_EQ(taken.size(), n);
    for (std::size_t k = 0; k < n; ++k) {
        ASSERT_EQ(taken[k].i, backwards[k]);
        std::vector<double> dense(n, 0.0);
        for (std::size_t e = 0; e < taken[k].columns.size(); ++e)
            dense[taken[k].columns[e]] = taken[k].factors[e];
        EXPECT_EQ(dense, engine.factors()[backwards[k]]);
    }
    EXPECT_EQ(rows.rays(), 10 * n);
}

TEST(StreamedRows, ReportTheRowsAsTheyWereMeasured) {
    const std::vector<double> areas{1.0, 3.0};
    const PatchMesh mesh = mesh_of(areas);
    const MatrixEngine engine({{0.0, 0.9}, {0.3, 0.0}});
    StreamedRows rows(engine, mesh);
    taken_from(rows, {0});
    taken_from(rows, {1});
    EXPECT_NEAR(rows.closure().row_sum_min, 0.3, rounding);
    EXPECT_NEAR(rows.closure().row_sum_max, 0.9, rounding);
    EXPECT_NEAR(rows.closure().row_sum_mean, (0.9 + 3.0 * 0.3) / 4.0, rounding);
    EXPECT_NEAR(rows.closure().closure_max, 0.0, rounding);
    EXPECT_TRUE(rows.open());
}

TEST(StreamedRows, AreClosedEachOnItsOwn) {
    constexpr std::size_t n = 40;
    constexpr double lost = 0.02;
    const LossyEngine engine(random_rows(n, 1.0, 5), lost);
    const PatchMesh mesh = mesh_of(std::vector<double>(n, 1.0));
    StreamedRows rows(engine, mesh);
    for (const Taken& row : taken_from(rows, first_patches(n)))
        EXPECT_NEAR(std::accumulate(row.factors.begin(), row.factors.end(), 0.0), 1.0, rounding)
            << row.i;
    EXPECT_NEAR(rows.closure().closure_max, lost, rounding);
    EXPECT_NEAR(rows.closure().row_sum_mean, 1.0 - lost, rounding);
    EXPECT_FALSE(rows.open());
}

TEST(EstimateDensity, IsTheShareOfPairsThatSeeEachOther) {
    for (const std::size_t n : {1u, 7u, 300u}) {
        std::vector<std::vector<double>> factors(n, std::vector<double>(n, 0.0));
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; j += 4) factors[i][j] = 1.0 / static_cast<double>(n);
        const double dense = static_cast<double>((n + 3) / 4) / static_cast<double>(n);
        EXPECT_NEAR(estimate_density(MatrixEngine(factors), mesh_of(std::vector<double>(n, 1.0))),
                    dense, rounding);
    }
}

TEST(EstimateDensity, SamplesAllOverTheMesh) {
    constexpr std::size_t n = 400;
    std::vector<std::vector<double>> factors(n, std::vector<double>(n, 0.0));
    for (std::size_t i = n / 2; i < n; ++i) factors[i].assign(n, 1.0 / n);  // the others see none
    constexpr double one_row = 1.0 / 48;                                    // of the sample
    EXPECT_NEAR(estimate_density(MatrixEngine(factors), mesh_of(std::vector<double>(n, 1.0))), 0.5,
                one_row);
}

}  // namespace
}  // namespace patchlight::factor_rows_test
