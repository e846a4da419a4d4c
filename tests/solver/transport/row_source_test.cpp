#include "solver/transport/row_source.h"

#include "tests/solver/transport/row_engines.h"

#include <gtest/gtest.h>

#include <numeric>

namespace patchlight::row_source_test {
namespace {

constexpr std::size_t patches = 30;
constexpr std::size_t plenty = 1 << 20;  // bytes

std::vector<PatchIndex> all_patches() {
    std::vector<PatchIndex> all(patches);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

TEST(RowSource, GivesTheEnginesRows) {
    const MatrixEngine engine(random_rows(patches, 0.6, 1));
    RowSource rows(engine, patches, plenty);
    const std::vector<PatchIndex> wanted{7, 3, 29};
    const auto found = rows.fetch(wanted);
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        double sum = found[k]->outside.backs + found[k]->outside.escaped;
        for (std::size_t m = 0; m < found[k]->columns.size(); ++m) {
            EXPECT_EQ(found[k]->factors[m],
                      static_cast<float>(engine.factors()[wanted[k]][found[k]->columns[m]]));
            sum += static_cast<double>(found[k]->factors[m]);
        }
        EXPECT_NEAR(sum, 1.0, 1e-6) << "closed, up to floats";
    }
    EXPECT_TRUE(rows.fetch({}).empty());
}

TEST(RowSource, KeepsWhatFitsAndComputesTheRestAnew) {
    const MatrixEngine engine(random_rows(patches, 0.6, 2));
    RowSource whole(engine, patches, plenty), none(engine, patches, 0);
    for (int pass = 0; pass < 3; ++pass) {
        whole.fetch(all_patches());
        none.fetch(all_patches());
    }
    EXPECT_EQ(whole.computed(), patches);
    EXPECT_EQ(none.computed(), 3 * patches);
    EXPECT_EQ(none.bytes(), 0u);
    EXPECT_EQ(whole.rays(), 10 * patches);
    EXPECT_EQ(none.rays(), 30 * patches);

    const std::size_t third = whole.bytes() / 3;
    RowSource some(engine, patches, third);
    for (int pass = 0; pass < 3; ++pass) some.fetch(all_patches());
    EXPECT_LE(some.bytes(), third);
    EXPECT_GT(some.bytes(), third / 2);
    EXPECT_GT(some.computed(), patches);
    EXPECT_LT(some.computed(), 3 * patches);
    EXPECT_EQ(engine.asked(),
              static_cast<int>(whole.computed() + none.computed() + some.computed()));
}

TEST(RowSource, KeepsTheRowsThatWereAskedForFirst) {
    const MatrixEngine engine(alike(patches));
    RowSource probe(engine, patches, plenty);
    probe.fetch(std::vector<PatchIndex>{0});
    RowSource rows(engine, patches, 2 * probe.bytes());
    rows.fetch(std::vector<PatchIndex>{4, 9});
    rows.fetch(std::vector<PatchIndex>{1});
    EXPECT_EQ(rows.computed(), 3u);
    rows.fetch(std::vector<PatchIndex>{9, 4});
    EXPECT_EQ(rows.computed(), 3u);
    rows.fetch(std::vector<PatchIndex>{1});
    EXPECT_EQ(rows.computed(), 4u);
}

TEST(RowSource, ReportsEachRowSeenOnceAsTheEngineGaveIt) {
    std::vector<std::vector<double>> factors = alike(4);
    for (double& factor : factors[2]) factor *= 0.25;
    const MatrixEngine engine(factors);
    RowSource rows(engine, 4, 0);
    EXPECT_EQ(rows.closure().row_sum_max, 0.0) << "nothing yet";
    for (int pass = 0; pass < 2; ++pass) rows.fetch(std::vector<PatchIndex>{2, 0});
    const ClosureReport report = rows.closure();
    EXPECT_NEAR(report.row_sum_min, 0.25, 1e-12);
    EXPECT_NEAR(report.row_sum_max, 1.0, 1e-12);
    EXPECT_NEAR(report.row_sum_mean, 0.625, 1e-12);
    EXPECT_LT(report.closure_max, 1e-12);
}

}  // namespace
}  // namespace patchlight::row_source_test
