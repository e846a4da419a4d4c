#include "server/wording.h"

#include <gtest/gtest.h>

namespace patchlight::server::wording_test {
namespace {

TEST(Wording, TheNearestNameIsSuggested) {
    const std::vector<std::string> known{"reflectance", "exitance", "vertical_fov"};
    EXPECT_EQ(suggestion("refletcance", known), "; did you mean 'reflectance'?");
    EXPECT_EQ(suggestion("fov", known), "; did you mean 'vertical_fov'?");
    EXPECT_EQ(suggestion("Exitance", known), "; did you mean 'exitance'?");
}

TEST(Wording, WhereNothingIsNearTheKnownAreListed) {
    EXPECT_EQ(suggestion("zebra", {"floor", "wall"}), "; known here: floor, wall");
    EXPECT_EQ(suggestion("zebra", {}), "");
}

TEST(Wording, QuotedTextIsShortAndPrintable) {
    EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
    EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 80u);
    const std::string two_byte_letters = [] {
        std::string text = "x";
        for (int k = 0; k < 60; ++k) text += "é";
        return text;
    }();
    EXPECT_EQ(in_quotes(two_byte_letters).substr(1 + 61, 3), "…");  // between letters, not inside
}

TEST(Wording, NumbersReadBackAsTheyAre) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(std::stod(number_text(1.0 / 3.0)), 1.0 / 3.0);
}

}  // namespace
}  // namespace patchlight::server::wording_test
