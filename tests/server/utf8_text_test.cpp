#include "server/utf8_text.h"

#include <gtest/gtest.h>

namespace patchlight::server::utf8_text_test {
namespace {

TEST(Utf8Text, StaysAsItIs) {
    for (const char* text : {"", "plain", "Küche", "居間", "\U0001F6CB sofa", "\uFFFD"})
        EXPECT_EQ(as_utf8(text), text);
}

TEST(Utf8Text, OtherBytesBecomeQuestionMarks) {
    EXPECT_EQ(as_utf8("K\xFC"
                      "che"),
              "K?che");               // Latin-1
    EXPECT_EQ(as_utf8("\xC3"), "?");  // cut off
    EXPECT_EQ(as_utf8("\xE2\x82"), "??");
    EXPECT_EQ(as_utf8("\xC0\xAF"), "??");  // longer than need be
    EXPECT_EQ(as_utf8("\xE0\x80\xAF"), "???");
    EXPECT_EQ(as_utf8("\xED\xA0\x80"), "???");       // half a surrogate pair
    EXPECT_EQ(as_utf8("\xF4\x90\x80\x80"), "????");  // beyond the last character
    EXPECT_EQ(as_utf8("\x80\xFF"), "??");
}

}  // namespace
}  // namespace patchlight::server::utf8_text_test
