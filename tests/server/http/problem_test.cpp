#include "server/http/problem.h"

#include <gtest/gtest.h>

namespace patchlight::server::problem_test {
namespace {

nlohmann::json document_of(const HttpAnswer& answer) {
    EXPECT_EQ(answer.content_type, "application/problem+json");
    return nlohmann::json::parse(answer.body);
}

TEST(Problem, HasTheMembersOfItsStandardAndItsOwn) {
    const auto document =
        document_of(answer_of({422, "scene-invalid", "Title", "detail", {{"pointer", "/a"}}}));
    EXPECT_EQ(document["type"], "urn:patchlight:scene-invalid");
    EXPECT_EQ(document["title"], "Title");
    EXPECT_EQ(document["status"], 422);
    EXPECT_EQ(document["detail"], "detail");
    EXPECT_EQ(document["pointer"], "/a");
    EXPECT_EQ(document_of(answer_of({404, "a", "b", "c", {}})).size(), 4U);
}

TEST(Problem, ShowsBytesThatAreNoTextWithoutFailing) {
    EXPECT_EQ(document_of(answer_of({400, "a", "b", "x\xffy", {}}))["detail"], "x\uFFFDy");
}

TEST(Problem, AsksToComeBackAfterWholeSeconds) {
    const auto seconds = [](double wait) {
        return try_again_later({503, "a", "b", "c", {}}, wait).fields.front().second;
    };
    EXPECT_EQ(seconds(0.0), "1");
    EXPECT_EQ(seconds(1.2), "2");
    EXPECT_EQ(seconds(1e9), "3600");
}

}  // namespace
}  // namespace patchlight::server::problem_test
