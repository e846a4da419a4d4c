#include "server/files/base64.h"

#include <gtest/gtest.h>

namespace patchlight::server::base64_test {
namespace {

TEST(Base64, TheExamplesOfTheStandardAreDecoded) {
    // RFC 4648, section 10
    EXPECT_EQ(decode_base64(""), "");
    EXPECT_EQ(decode_base64("Zg=="), "f");
    EXPECT_EQ(decode_base64("Zm8="), "fo");
    EXPECT_EQ(decode_base64("Zm9v"), "foo");
    EXPECT_EQ(decode_base64("Zm9vYg=="), "foob");
    EXPECT_EQ(decode_base64("Zm9vYmE="), "fooba");
    EXPECT_EQ(decode_base64("Zm9vYmFy"), "foobar");
    EXPECT_EQ(decode_base64("Zm9vYg"), "foob");
}

TEST(Base64, AnythingElseIsRefused) {
    for (const char* text : {"A", "Zm9vY", "Zm9v!", "Zm 9v", "Zg=a", "====", "Zm9v\n"})
        EXPECT_FALSE(decode_base64(text)) << text;
}

}  // namespace
}  // namespace patchlight::server::base64_test
