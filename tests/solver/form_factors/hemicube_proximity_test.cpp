#include "tests/slope.h"
#include "tests/solver/form_factors/closed_forms.h"
#include "tests/solver/form_factors/hemicube_pairs.h"
#include "tests/solver/solutions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::hemicube_proximity_test {
namespace {

constexpr int resolution = 64;
constexpr int seeds = 16;
/// Of the mean over the seeds, whose own scatter tells its error: with 15 degrees of freedom false
/// alarm 1 in 6000 for each comparison.
constexpr double deviations = 5.0;

struct Mean {
    double value = 0.0, error = 0.0;  // its standard error
};

Mean mean_factor(const HemicubePair& pair, int k) {
    std::vector<double> found;
    Mean mean;
    for (int seed = 1; seed <= seeds; ++seed) {
        const HemicubeEngine engine = pair.engine(resolution, k, static_cast<std::uint64_t>(seed));
        found.push_back(HemicubePair::entry(engine).factor);
        mean.value += found.back() / seeds;
    }
    for (const double factor : found)
        mean.error += std::pow(factor - mean.value, 2) / (seeds * (seeds - 1.0));
    mean.error = std::sqrt(mean.error);
    return mean;
}

/// A target on the axis of its hemicube is seen by nearly the same cells at every turn: there seeds
/// do not average the aliasing, which is that of `cells` in k² hemicubes. Three standard errors.
double aliasing(double factor, int k) {
    const double cells = std::numbers::pi / 4.0 * factor * resolution * resolution * k * k;
    return 3.0 * factor * std::sqrt(k / (3.0 * cells * std::sqrt(cells)));
}

TEST(HemicubeProximity, OfFacingSquaresIsThatOfTheTable) {
    const nlohmann::json rows = solution_case("s-d15")["rows"];
    int checked = 0;
    for (const auto& row : rows) {
        const double distance = row["distance"].get<double>();
        if (distance < 0.01) continue;
        const HemicubePair pair = parallel_pair(distance);
        for (const int k : {1, 2, 4, 8}) {
            const std::string parts = std::to_string(k) + "x" + std::to_string(k);
            const double known = row["centre_sampling_" + parts].get<double>();
            EXPECT_NEAR(pair.at_centres(k), known, 1e-12);
            const Mean found = mean_factor(pair, k);
            EXPECT_NEAR(found.value, known, deviations * found.error + aliasing(known, k))
                << "distance " << distance << ", " << parts << " hemicubes";
            ++checked;
        }
    }
    EXPECT_EQ(checked, 36);
}

TEST(HemicubeProximity, FallsAsTheSquareOfThePartsOnceTheyAreSmallForTheDistance) {
    for (const double distance : {1.0, 0.5}) {
        const double exact = parallel_rectangles(1, 1, distance);
        std::vector<double> parts, errors;
        for (const int k : {1, 2, 4}) {
            parts.push_back(k);
            errors.push_back(std::abs(mean_factor(parallel_pair(distance), k).value - exact));
        }
        const Slope slope = fit_slope(parts, errors);
        RecordProperty("slope_" + std::to_string(distance), std::to_string(slope.value));
        EXPECT_NEAR(slope.value, -2.0, 0.3) << "the table's own: -2.19 and -2.14";
    }
}

TEST(HemicubeProximity, DoesNotFallInAGapNarrowerThanTheParts) {
    const double exact = parallel_rectangles(1, 1, 0.01);
    const double coarse = mean_factor(parallel_pair(0.01), 1).value - exact;
    const double fine = mean_factor(parallel_pair(0.01), 4).value - exact;
    EXPECT_GT(fine, 0.8 * coarse) << "0.0182 beside 0.0196 in the table";
}

TEST(HemicubeProximity, OfPerpendicularSquaresIsThatOfTheTable) {
    const nlohmann::json known = solution_case("s-d16")["rows"];
    const HemicubePair pair = perpendicular_pair();
    int checked = 0;
    for (const auto& row : known["rows"]) {
        if (!row.contains("subdivision")) continue;
        const int k = row["subdivision"].get<int>();
        const double mean = row["mean"].get<double>();
        EXPECT_NEAR(pair.at_centres(k), mean, 1e-12);
        const Mean found = mean_factor(pair, k);
        EXPECT_NEAR(found.value, mean, deviations * found.error + aliasing(mean, k)) << k;
        ++checked;
    }
    EXPECT_EQ(checked, 5);
    EXPECT_NEAR(known["exact"].get<double>(), perpendicular_rectangles(1, 1, 1), 1e-12);
}

TEST(HemicubeProximity, MoreCellsDoNotMendIt) {
    const HemicubePair pair = parallel_pair(1.0);
    const double exact = parallel_rectangles(1, 1, 1);
    for (const int cells : {64, 128, 256})
        EXPECT_NEAR(HemicubePair::entry(pair.engine(cells, 1)).factor / exact - 1.0, 0.198, 0.01);
}

TEST(HemicubeProximity, IsMendedToTwoPercentByTheNumberOfPartsItChooses) {
    for (const double distance : {10.0, 5.0, 2.0, 1.0, 0.5}) {
        const HemicubePair pair = parallel_pair(distance);
        const int k = pair.engine(resolution, 0).sub_samples(0);
        const double exact = parallel_rectangles(1, 1, distance);
        EXPECT_NEAR(pair.at_centres(k), exact, 0.02 * exact) << distance << ' ' << k;
    }
}

}  // namespace
}  // namespace patchlight::hemicube_proximity_test
