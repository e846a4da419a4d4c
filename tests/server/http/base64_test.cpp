#include "server/http/base64.h"

#include <gtest/gtest.h>

namespace patchlight::server::base64_test {
namespace {

TEST(Base64, GivesTheTextsOfItsStandard) {  // RFC 4648, section 10
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAnyBytes) { EXPECT_EQ(base64({"\xff\xfe\x00\x80", 4}), "//4AgA=="); }

}  // namespace
}  // namespace patchlight::server::base64_test
