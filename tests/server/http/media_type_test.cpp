#include "server/http/media_type.h"

#include <gtest/gtest.h>

#include <array>

namespace patchlight::server::media_type_test {
namespace {

const std::array<std::string, 3> offered{"image/png", "image/x-exr", "application/json"};

std::string choice(std::string_view accept) {
    return negotiated_type(accept, offered).value_or("none");
}

TEST(MediaType, TheFirstOfferedStandsForAnything) {
    EXPECT_EQ(negotiated_type(std::nullopt, offered), "image/png");
    for (const char* any : {"", "  ", "*/*", "*", "image/*", "text/html, */*;q=0.1"})
        EXPECT_EQ(choice(any), "image/png") << any;
}

TEST(MediaType, TheHighestQualityWins) {
    EXPECT_EQ(choice("application/json"), "application/json");
    EXPECT_EQ(choice("image/png;q=0.5, application/json"), "application/json");
    EXPECT_EQ(choice("image/png;q=0.5,application/json;q=0.4"), "image/png");
    EXPECT_EQ(choice("IMAGE/X-EXR; charset=x ; Q=0.9, */*;q=0.1"), "image/x-exr");
    EXPECT_EQ(choice("application/*, image/*;q=0.3"), "application/json");
}

TEST(MediaType, TheClosestRangeDecidesForAType) {
    EXPECT_EQ(choice("image/png;q=0, */*"), "image/x-exr");
    EXPECT_EQ(choice("image/*;q=0, */*;q=0.1"), "application/json");
    EXPECT_EQ(choice("*/*;q=1, image/png;q=0.2"), "image/x-exr");
}

TEST(MediaType, NothingMayFit) {
    for (const char* accept : {"image/gif", "text/html", "*/*;q=0", "image/png;q=0.0",
                               "image/png;q=high", "image/png;q=-1", "image", ",,;;=", "image/pn"})
        EXPECT_EQ(choice(accept), "none") << accept;
}

TEST(MediaType, ParametersAndCapitalsDoNotMatter) {
    EXPECT_EQ(media_type("Application/JSON; charset=utf-8"), "application/json");
    EXPECT_EQ(media_type("  text/plain "), "text/plain");
    EXPECT_EQ(media_type(""), "");
}

}  // namespace
}  // namespace patchlight::server::media_type_test
