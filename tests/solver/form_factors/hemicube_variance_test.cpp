#include "solver/form_factors/analytic_engine.h"
#include "tests/solver/form_factors/hemicube_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace patchlight::hemicube_variance_test {
namespace {

constexpr int seeds = 12;

/// Mean over seeds of an entry's squared distance to the exact factor, and of what the engine says.
struct Spread {
    double observed = 0.0, said = 0.0;
    double ratio() const { return said / observed; }
};

std::map<PatchIndex, Spread> spreads(const EngineScene& scene, PatchIndex i, int resolution) {
    const AnalyticEngine analytic(scene.cut.scene, scene.cut.mesh, scene.rays, {});
    FactorRow exact;
    analytic.whole_row(i, exact);
    std::map<PatchIndex, Spread> spread;
    for (int seed = 1; seed <= seeds; ++seed) {
        HemicubeSettings settings;
        settings.resolution = resolution;
        settings.seed = static_cast<std::uint64_t>(seed);
        const HemicubeEngine engine(scene.cut.scene, scene.cut.mesh, scene.rays, settings);
        const FactorRow row = row_of(engine, i);
        std::map<PatchIndex, std::size_t> at;
        for (std::size_t k = 0; k < row.columns.size(); ++k) at[row.columns[k]] = k;
        for (std::size_t k = 0; k < exact.columns.size(); ++k) {
            const auto seen = at.find(exact.columns[k]);
            const bool missed = seen == at.end();
            Spread& of_pair = spread[exact.columns[k]];
            const double factor = missed ? 0.0 : row.factors[seen->second];
            of_pair.observed += std::pow(factor - exact.factors[k], 2) / seeds;
            of_pair.said += (missed ? 0.0 : row.variance[seen->second]) / seeds;
        }
    }
    return spread;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
    return values[values.size() / 2];
}

class HemicubeVariance : public testing::TestWithParam<int> {};  // resolution

/// From a corner, beside an edge and in the middle of a floor: how patches usually lie.
TEST_P(HemicubeVariance, IsTheSquaredErrorOfRoomsWithinAFactorOfThree) {
    const EngineScene scene(room(), 0.125);
    const auto& mesh = scene.cut.mesh;
    std::map<std::string, std::vector<double>> ratios;
    std::map<std::string, Spread> sums;
    for (const PatchIndex i : {PatchIndex{0}, PatchIndex{1}, PatchIndex{3 * 8 + 3}})
        for (const auto& [j, spread] : spreads(scene, i, GetParam())) {
            const double distance =
                (mesh.patches[j].centre - mesh.patches[i].centre).norm() / mesh.patch_size;
            const std::string where = mesh.patches[j].surface == 1 ? "facing"
                                      : distance < 0.8             ? "touching"
                                      : distance < 2.2             ? "near"
                                                                   : "far";
            ratios[where].push_back(spread.ratio());
            sums[where].observed += spread.observed;
            sums[where].said += spread.said;
        }
    ASSERT_EQ(ratios.size(), 4u);
    for (const auto& [where, found] : ratios) {
        RecordProperty("median_" + where, std::to_string(median(found)));
        RecordProperty("sum_" + where, std::to_string(sums[where].ratio()));
        const double most =
            where == "touching" ? 8.0 : 3.0;  // those err less than their neighbours
        EXPECT_GT(median(found), 1.0 / 3.0) << where;
        EXPECT_LT(median(found), most) << where;
        EXPECT_GT(sums[where].ratio(), 1.0 / 3.0) << where;
        EXPECT_LT(sums[where].ratio(), most) << where;
    }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, HemicubeVariance, testing::Values(32, 64, 128, 256));

/// Standard error said over the error of the table s-d15, with so many cells that it is proximity.
TEST(HemicubeVarianceOfAPair, TellsTheProximityOfFacingSquaresWithinAFactorOfThree) {
    for (const double distance : {2.0, 1.0, 0.5, 0.2, 0.1, 0.05})
        for (const int k : {1, 2, 4}) {
            const HemicubePair pair = parallel_pair(distance);
            const double said = std::sqrt(HemicubePair::entry(pair.engine(128, k)).variance);
            const double exact = pair.at_centres(64);  // to 1 / 300 of the error of k = 4
            const double error = std::abs(pair.at_centres(k) - exact);
            EXPECT_GT(said, error / 3.0) << distance << ' ' << k;
            EXPECT_LT(said, error * 3.0) << distance << ' ' << k;
        }
}

}  // namespace
}  // namespace patchlight::hemicube_variance_test
