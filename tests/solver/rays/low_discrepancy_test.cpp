#include "solver/rays/low_discrepancy.h"

#include <gtest/gtest.h>

#include <set>

namespace patchlight::low_discrepancy_test {
namespace {

/// Whether every interval of 2^-a by 2^-(m-a) holds exactly one of the first 2^m points.
template <typename Coordinate>
bool is_net(unsigned m, const Coordinate& coordinate) {
    const std::size_t count = std::size_t{1} << m;
    for (unsigned a = 0; a <= m; ++a) {
        std::set<std::pair<unsigned, unsigned>> taken;
        for (std::size_t k = 0; k < count; ++k)
            taken.emplace(static_cast<unsigned>(coordinate(0, k) * (1u << a)),
                          static_cast<unsigned>(coordinate(1, k) * (1u << (m - a))));
        if (taken.size() != count) return false;
    }
    return true;
}

TEST(SobolPoints, AreANetInTheFirstTwoDimensions) {
    const SobolPoints points(1024);
    for (unsigned m = 0; m <= 10; ++m)
        EXPECT_TRUE(is_net(m, [&](std::size_t d, std::size_t k) {
            return reverse_bits(points.reversed(d)[k]) * 0x1p-32;
        })) << m;
}

TEST(SobolPoints, StayANetWhenScrambled) {
    const SobolPoints points(256);
    for (std::uint32_t seed = 0; seed < 50; ++seed)
        EXPECT_TRUE(is_net(8, [&](std::size_t d, std::size_t k) {
            return static_cast<double>(points.at(d, k, seed * 77 + static_cast<std::uint32_t>(d)));
        })) << seed;
}

TEST(SobolPoints, HaveOnePointInEachIntervalOfEveryDimension) {
    const SobolPoints points(512);
    for (std::size_t d = 0; d < SobolPoints::dimensions; ++d) {
        std::set<int> taken;
        for (std::size_t k = 0; k < 512; ++k)
            taken.insert(static_cast<int>(points.at(d, k, 99) * 512.0f));
        EXPECT_EQ(taken.size(), 512u) << d;
        EXPECT_EQ(*taken.begin(), 0);
        EXPECT_EQ(*taken.rbegin(), 511);
    }
}

TEST(SobolPoints, DifferUnderDifferentScrambles) {
    const SobolPoints points(64);
    std::set<float> first;
    for (std::uint32_t seed = 0; seed < 1000; ++seed) first.insert(points.at(0, 0, seed));
    EXPECT_GT(first.size(), 990u);  // floats of 24 bits: a coincidence or two
}

TEST(SobolPoints, AreThereToTheEndOfABatch) {
    EXPECT_EQ(SobolPoints(5).size(), 5u);
    EXPECT_EQ(SobolPoints(5).reversed(3)[15], SobolPoints(64).reversed(3)[15]);
}

TEST(ReverseBits, IsItsOwnInverse) {
    EXPECT_EQ(reverse_bits(1u), 0x80000000u);
    EXPECT_EQ(reverse_bits(0x0000000fu), 0xf0000000u);
    for (std::uint32_t x = 1; x < 1u << 30; x *= 3) EXPECT_EQ(reverse_bits(reverse_bits(x)), x);
}

TEST(Mix, GivesNearInputsDifferentOutputs) {
    std::set<std::uint64_t> outputs;
    for (std::uint64_t a = 0; a < 300; ++a)
        for (std::uint64_t b = 0; b < 300; ++b) outputs.insert(mix(a, b));
    EXPECT_EQ(outputs.size(), 90000u);
}

}  // namespace
}  // namespace patchlight::low_discrepancy_test
