#include "server/http/chunk_check.h"

#include <gtest/gtest.h>

#include <string>

namespace patchlight::server::chunk_check_test {
namespace {

constexpr std::string_view body = "3;name=value\r\nabc\r\n0A\r\n0123456789\r\n0\r\nX: y\r\n\r\n";

TEST(ChunkCheck, FollowsABodyInPiecesOfAnySize) {
    for (std::size_t size = 1; size <= body.size(); ++size) {
        ChunkCheck check;
        for (std::size_t begin = 0; begin < body.size(); begin += size) {
            EXPECT_FALSE(check.is_complete());
            ASSERT_TRUE(check.accepts(body.substr(begin, size))) << size << " at " << begin;
        }
        EXPECT_TRUE(check.is_complete());
        EXPECT_FALSE(check.accepts("x")) << "nothing may follow";
    }
}

TEST(ChunkCheck, RefusesWhatTheGrammarDoesNotHave) {
    for (const char* wrong :
         {"-2\r\n", "+2\r\n", "0x2\r\n", " 2\r\n", "\r\n", ";a\r\n", "2\n", "2\rab", "2\r\nabc",
          "2\r\nab\n", "2\r\nab\r\n\r\n", "ffffffffffffffff\r\n", "2;a\nb", "0\r\nX: y\n",
          "0\r\n\rx", "2g\r\n"})
        EXPECT_FALSE(ChunkCheck().accepts(wrong)) << wrong;
}

TEST(ChunkCheck, RefusesExtensionsAndTrailersWithoutEnd) {
    EXPECT_FALSE(ChunkCheck().accepts("2;" + std::string(8193, 'a')));
    EXPECT_FALSE(ChunkCheck().accepts("0\r\n" + std::string(8193, 'a')));
    ChunkCheck many;
    bool is_accepted = true;
    for (int k = 0; k < 1000; ++k) is_accepted = many.accepts("1;0123456789\r\nx\r\n");
    EXPECT_FALSE(is_accepted) << "small ones add up";
}

}  // namespace
}  // namespace patchlight::server::chunk_check_test
