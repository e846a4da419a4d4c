#include "solver/rays/penumbra.h"

#include <gtest/gtest.h>

namespace patchlight::penumbra_test {
namespace {

std::vector<bool> chosen(const std::vector<FirstLook>& looks) { return in_penumbra(looks); }

TEST(InPenumbra, WhereNeighboursAgreeNothingMoreIsAsked) {
    EXPECT_EQ(chosen({{0, 4, 4}, {0, 4, 4}, {0, 4, 4}, {0, 4, 4}}), std::vector<bool>(4, false));
    EXPECT_EQ(chosen({{0, 0, 4}, {0, 0, 4}, {0, 0, 4}}), std::vector<bool>(3, false));
}

TEST(InPenumbra, ATargetsOwnSamplesHaveNoSay) {
    const std::vector<FirstLook> all_clear(5, {0, 4, 4});
    std::vector<FirstLook> one_mixed = all_clear;
    one_mixed[2] = {0, 2, 4};
    EXPECT_EQ(chosen(one_mixed), (std::vector<bool>{true, true, false, true, true}));
}

TEST(InPenumbra, NeighboursThatDisagreeWithOneAnotherChooseATarget) {
    EXPECT_EQ(chosen({{0, 4, 4}, {0, 4, 4}, {0, 4, 4}, {0, 0, 4}, {0, 0, 4}, {0, 0, 4}}),
              (std::vector<bool>{false, true, true, true, true, false}));
}

TEST(InPenumbra, NeighboursAreOfOneSurface) {
    EXPECT_EQ(chosen({{0, 4, 4}, {0, 4, 4}, {0, 4, 4}, {1, 0, 4}, {1, 0, 4}, {1, 0, 4}}),
              std::vector<bool>(6, false));
}

TEST(InPenumbra, ATargetWithoutTwoNeighboursIsAlwaysChosen) {
    EXPECT_EQ(chosen({{0, 4, 4}}), std::vector<bool>{true});
    EXPECT_EQ(chosen({{0, 4, 4}, {0, 4, 4}, {1, 4, 4}}), std::vector<bool>(3, true));
    EXPECT_TRUE(chosen({}).empty());
}

}  // namespace
}  // namespace patchlight::penumbra_test
