#include "solver/transport/gather.h"

#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::gather_test {
namespace {

constexpr double rounding = 1e-14;    // of a sum of some hundred terms of one sign, relative
constexpr std::size_t patches = 203;  // no multiple of any vector's width

Field random_field(std::size_t channels) {
    std::mt19937 chance(1);
    Field field(channels, std::vector<double>(patches));
    for (auto& channel : field)
        for (double& b : channel) b = uniform(chance);
    return field;
}

double naive_sum(const FormFactorMatrix& factors, PatchIndex i, const std::vector<double>& b,
                 PatchIndex begin, PatchIndex end) {
    double sum = 0.0;
    for (PatchIndex j = begin; j < end; ++j) sum += factors.at(i, j) * b[j];
    return sum;
}

class GatherOf : public testing::TestWithParam<std::tuple<double, std::size_t>> {
  protected:
    const FormFactorMatrix factors_{random_closed(patches, std::get<0>(GetParam()), 1)};
    const Field radiosity_ = random_field(std::get<1>(GetParam()));
};

TEST_P(GatherOf, IsTheSumOverTheRow) {
    for (PatchIndex i = 0; i < patches; ++i) {
        const Gathered sums = gather(factors_, i, radiosity_, 0, patches);
        for (std::size_t c = 0; c < radiosity_.size(); ++c) {
            const double expected = naive_sum(factors_, i, radiosity_[c], 0, patches);
            EXPECT_NEAR(sums[c], expected, rounding * expected);
        }
    }
}

TEST_P(GatherOf, CanBeTakenOverPartsOfTheRow) {
    for (const auto& [begin, end] : {std::pair(0u, 1u),
                                     {0u, 128u},
                                     {5u, 5u},
                                     {7u, 9u},
                                     {128u, 203u},
                                     {33u, 110u},
                                     {202u, 203u}})
        for (const PatchIndex i : {0u, 17u, 202u}) {
            const Gathered sums = gather(factors_, i, radiosity_, begin, end);
            for (std::size_t c = 0; c < radiosity_.size(); ++c)
                EXPECT_NEAR(sums[c], naive_sum(factors_, i, radiosity_[c], begin, end), rounding);
        }
}

TEST_P(GatherOf, SeveralRowsAtOnceIsThatOfEachByItself) {
    for (const auto& [begin, end] : {std::pair(0u, 203u), {0u, 128u}, {130u, 203u}})
        for (const auto& [first, last] :
             {std::pair(0u, 4u), {100u, 104u}, {201u, 203u}, {9u, 10u}}) {
            const auto sums = gather_some(factors_, first, last, radiosity_, begin, end);
            for (PatchIndex i = first; i < last; ++i)
                EXPECT_EQ(sums[i - first], gather(factors_, i, radiosity_, begin, end));
        }
}

TEST_P(GatherOf, AllRowsIsThatOfEach) {
    const Field irradiance = gather_all(factors_, radiosity_);
    ASSERT_EQ(irradiance.size(), radiosity_.size());
    for (PatchIndex i = 0; i < patches; ++i)
        for (std::size_t c = 0; c < radiosity_.size(); ++c)
            EXPECT_EQ(irradiance[c][i], gather(factors_, i, radiosity_, 0, patches)[c]);
}

INSTANTIATE_TEST_SUITE_P(Gather, GatherOf,
                         testing::Combine(testing::Values(1.0, 0.5, 0.05),  // dense, mixed, sparse
                                          testing::Values(std::size_t{1}, std::size_t{3})));

TEST(ForRowsTogether, VisitsEachRowOnce) {
    for (const auto& [first, last] : {std::pair(0u, 203u), {5u, 6u}, {3u, 3u}, {7u, 140u}}) {
        std::vector<int> visits(203, 0);
        for_rows_together(first, last, [&](PatchIndex begin, PatchIndex end) {
            EXPECT_LE(end - begin, rows_together);
            for (PatchIndex i = begin; i < end; ++i) ++visits[i];
        });
        for (PatchIndex i = 0; i < 203; ++i) EXPECT_EQ(visits[i], i >= first && i < last) << i;
    }
}

}  // namespace
}  // namespace patchlight::gather_test
