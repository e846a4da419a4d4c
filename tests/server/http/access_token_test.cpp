#include "server/http/access_token.h"

#include "server/wrong_input.h"

#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace patchlight::server::access_token_test {
namespace {

const std::string token = "0123456789abcdef";

bool passes(const std::string& field) {
    HttpRequest request;
    request.fields.emplace_back("authorization", field);
    return shows_token(request, token);
}

std::optional<std::string> from_file(const std::string& content) {
    return configured_token(test_file(write_test_file("token", content)));
}

TEST(AccessToken, IsShownByItsBearer) {
    EXPECT_TRUE(passes("Bearer " + token));
    EXPECT_TRUE(passes("bearer " + token));
    for (const std::string& wrong :
         {std::string(), token, std::string("Bearer"), std::string("Bearer "),
          "Bearer " + token + "0", "Bearer " + token.substr(1), "Basic " + token,
          "Bearer  " + token})
        EXPECT_FALSE(passes(wrong)) << wrong;
    EXPECT_FALSE(shows_token({}, token));
}

TEST(AccessToken, IsTheFirstLineOfAFile) {
    EXPECT_EQ(from_file(token + "\r\nmore\n"), token);
    EXPECT_THROW(from_file(""), WrongInput);
    EXPECT_THROW(from_file("short\n"), WrongInput);
    EXPECT_THROW(from_file("0123456789 abcdef\n"), WrongInput);
    EXPECT_THROW(configured_token(test_file("no such file")), WrongInput);
}

TEST(AccessToken, IsElseTakenFromTheEnvironment) {
    ::unsetenv("PATCHLIGHT_TOKEN");
    EXPECT_EQ(configured_token({}), std::nullopt);
    ::setenv("PATCHLIGHT_TOKEN", "fedcba9876543210", 1);
    EXPECT_EQ(configured_token({}), "fedcba9876543210");
    EXPECT_EQ(from_file(token), token) << "the file comes first";
    ::unsetenv("PATCHLIGHT_TOKEN");
}

TEST(AccessToken, IsMadeOfChance) {
    EXPECT_EQ(random_token().size(), 32U);
    EXPECT_NE(random_token(), random_token());
}

}  // namespace
}  // namespace patchlight::server::access_token_test
