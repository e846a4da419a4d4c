#include "server/http/request_log.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace patchlight::server::request_log_test {
namespace {

std::string logged(bool is_quiet, const HttpRequest& request) {
    testing::internal::CaptureStderr();
    RequestLog log(is_quiet);
    HttpAnswer answer;
    answer.route = "/v1/render";
    log.request(request, answer, {0.25, 1234, true});
    return testing::internal::GetCapturedStderr();
}

TEST(RequestLog, IsALineOfJsonARequest) {
    HttpRequest request;
    request.id = "abc";
    request.method = "POST";
    request.remote = "127.0.0.1";
    const std::string line = logged(false, request);
    const auto entry = nlohmann::json::parse(line);
    EXPECT_EQ(entry["id"], "abc");
    EXPECT_EQ(entry["route"], "/v1/render");
    EXPECT_EQ(entry["status"], 200);
    EXPECT_EQ(entry["ms"], 250.0);
    EXPECT_EQ(entry["bytes"], 1234);
    EXPECT_EQ(logged(true, request), "");
}

TEST(RequestLog, CannotBeLedToWriteMoreThanALine) {
    HttpRequest request;
    request.method = "GET\"}\n{\"event\": \"forged\x1b[31m\xff\u2028";
    request.query.emplace_back("token", "secret");
    request.fields.emplace_back("Authorization", "Bearer secret");
    const std::string line = logged(false, request);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    EXPECT_TRUE(
        std::all_of(line.begin(), line.end() - 1, [](char c) { return c >= 0x20 && c < 0x7F; }));
    EXPECT_EQ(nlohmann::json::parse(line)["event"], "request");
    EXPECT_EQ(line.find("secret"), std::string::npos);
}

TEST(RequestLog, FailuresAreWrittenEvenIfItIsQuiet) {
    testing::internal::CaptureStderr();
    RequestLog(true).failure({}, "disk {} on\nfire");
    const auto entry = nlohmann::json::parse(testing::internal::GetCapturedStderr());
    EXPECT_EQ(entry["what"], "disk {} on\nfire");
}

}  // namespace
}  // namespace patchlight::server::request_log_test
