#include "server/http/host_check.h"

#include <gtest/gtest.h>

namespace patchlight::server::host_check_test {
namespace {

TEST(HostCheck, OwnNamesAndAddressesPass) {
    const HostCheck check("lights.example", {"other.example"});
    for (const char* host :
         {"localhost", "LocalHost:8080", "127.0.0.1", "127.0.0.1:80", "[::1]", "[::1]:8080",
          "192.168.1.7:8080", "lights.example", "lights.example:8080", "Other.Example"})
        EXPECT_TRUE(check.passes(host)) << host;
}

TEST(HostCheck, NamesOfOthersDoNot) {
    const HostCheck check("0.0.0.0", {});
    for (const char* host : {"evil.example", "evil.example:8080", "localhost.evil.example",
                             "127.0.0.1.evil.example", "", ":80", "localhost:port",
                             "localhost:123456", "[evil.example]", "localhost ", "1.2.3", "::1"})
        EXPECT_FALSE(check.passes(host)) << host;
}

TEST(HostCheck, AnOriginIsOursIfItIsTheHost) {
    EXPECT_TRUE(is_same_origin("http://localhost:8080", "localhost:8080"));
    EXPECT_TRUE(is_same_origin("https://lights.example", "lights.example"));
    for (const char* origin : {"https://evil.example", "null", "", "http://localhost:81",
                               "file://localhost:8080", "http://localhost:8080.evil.example"})
        EXPECT_FALSE(is_same_origin(origin, "localhost:8080")) << origin;
    EXPECT_FALSE(is_same_origin("http://localhost", std::nullopt));
}

}  // namespace
}  // namespace patchlight::server::host_check_test
