#include "solver/scene/finding_words.h"

#include <gtest/gtest.h>

namespace patchlight::finding_words_test {
namespace {

TEST(FindingWords, PlacesAreRoundedToWhatTheirSizeMakesVisible) {
    EXPECT_EQ(place_text(Vec3(1.23456, -0.0001, 3.0), 5.6), "(1.235, 0, 3) m");
    EXPECT_EQ(place_text(Vec3(1.23456e-3, 2e-3, 0.0), 5.6e-3), "(0.001235, 0.002, 0) m");
    EXPECT_EQ(place_text(Vec3(12345.6, 0.0, 9.9), 5e4), "(12350, 0, 10) m");
    EXPECT_EQ(place_text(Vec3(1e8, 1e8 + 0.25, 0.5), 2.0), "(100000000, 100000000.25, 0.5) m");
    EXPECT_EQ(place_text(Vec3(1.5, 2.0, 3.0), 0.0), "(1.5, 2, 3) m");  // of a point
}

TEST(FindingWords, NumbersHaveAFewDigits) {
    EXPECT_EQ(length_text(0.0034567), "0.00346 m");
    EXPECT_EQ(share_text(0.01234), "1.2 %");
    EXPECT_EQ(quoted("a b"), "'a b'");
}

}  // namespace
}  // namespace patchlight::finding_words_test
