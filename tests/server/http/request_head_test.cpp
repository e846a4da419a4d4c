#include "server/http/request_head.h"

#include <gtest/gtest.h>

namespace patchlight::server::request_head_test {
namespace {

RequestHead head_of(const std::string& lines) {
    auto read = read_request_head(lines + "\r\n");
    if (const auto* const problem = std::get_if<Problem>(&read)) {
        ADD_FAILURE() << problem->detail << "\n" << lines;
        return {};
    }
    return std::get<RequestHead>(read);
}

TEST(RequestHead, TellsWhatTheRequestSays) {
    const RequestHead head = head_of(
        "POST /v1/render?camera=a%20b HTTP/1.1\r\nhost: x:80\r\nX:\t a b \t\r\nEmpty:\r\n"
        "content-length: 0012\r\n");
    EXPECT_EQ(head.method, "POST");
    EXPECT_EQ(head.target, "/v1/render?camera=a%20b");
    EXPECT_EQ(head.fields.at(1).second, "a b");
    EXPECT_EQ(head.fields.at(2).second, "");
    EXPECT_EQ(head.content_length, 12U);
    EXPECT_TRUE(head.has_body());
    EXPECT_TRUE(head.keeps_alive);
    EXPECT_FALSE(head.expects_continue);
}

TEST(RequestHead, KnowsWhetherABodyFollows) {
    EXPECT_FALSE(head_of("POST / HTTP/1.1\r\nHost: x\r\n").has_body());
    EXPECT_FALSE(head_of("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n").has_body());
    EXPECT_TRUE(head_of("POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: Chunked\r\n").is_chunked);
}

TEST(RequestHead, KeepsTheConnectionUnlessSomebodyEndsIt) {
    EXPECT_FALSE(head_of("GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n").keeps_alive);
    EXPECT_FALSE(head_of("GET / HTTP/1.1\r\nHost: x\r\nConnection: te, CLOSE\r\n").keeps_alive);
    EXPECT_TRUE(head_of("GET / HTTP/1.1\r\nHost: x\r\nConnection: closed\r\n").keeps_alive);
    EXPECT_FALSE(head_of("GET / HTTP/1.0\r\n").keeps_alive) << "which needs no Host either";
}

TEST(RequestHead, ALengthOfThirteenDigitsIsTooLarge) {
    const std::string fields = "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: ";
    EXPECT_EQ(head_of(fields + "999999999999\r\n").content_length, 999'999'999'999U);
    const auto read = read_request_head(fields + "1000000000000\r\n\r\n");
    ASSERT_TRUE(std::holds_alternative<Problem>(read));
    EXPECT_EQ(std::get<Problem>(read).status, 413);
}

TEST(RequestHead, TruncatedAnywhereItIsRefused) {
    const std::string whole = "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\n\r\n";
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_TRUE(std::holds_alternative<Problem>(read_request_head(whole.substr(0, length))))
            << length;
}

}  // namespace
}  // namespace patchlight::server::request_head_test
