#include "solver/display/near_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace patchlight::near_places_test {
namespace {

std::vector<Vec3> random_places(std::size_t count, double step) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Vec3> places(count);
    for (Vec3& p : places)  // on a lattice if there is a step: many equally far
        for (int d = 0; d < 3; ++d)
            p[d] = step > 0.0 ? std::floor(unit(random) / step) * step : unit(random);
    return places;
}

/// Squared distances of all that fit, ascending.
std::vector<double> by_looking_at_all(const std::vector<Vec3>& places, const Vec3& p, double reach,
                                      std::size_t most) {
    std::vector<double> squares;
    for (std::uint32_t k = 0; k < places.size(); ++k)
        if (const double square = (places[k] - p).squaredNorm();
            k % 3 != 0 && square <= reach * reach)
            squares.push_back(square);
    std::sort(squares.begin(), squares.end());
    squares.resize(std::min(squares.size(), most));
    return squares;
}

TEST(NearPlaces, AreThoseThatLookingAtAllFinds) {
    for (const double step : {0.0, 0.1})
        for (const std::size_t count : {0u, 1u, 2u, 17u, 500u}) {
            const std::vector<Vec3> places = random_places(count, step);
            const NearPlaces tree(places);
            for (const Vec3& p : random_places(40, 0.0))
                for (const double reach : {0.05, 0.3, 10.0}) {
                    const auto found =
                        tree.nearest(p, reach, 7, [](std::uint32_t k) { return k % 3 != 0; });
                    std::vector<double> squares;
                    for (const std::uint32_t k : found) {
                        EXPECT_NE(k % 3, 0u);
                        squares.push_back((places[k] - p).squaredNorm());
                    }
                    EXPECT_EQ(squares, by_looking_at_all(places, p, reach, 7));
                }
        }
}

}  // namespace
}  // namespace patchlight::near_places_test
