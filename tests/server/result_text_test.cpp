#include "server/result_text.h"

#include <gtest/gtest.h>

namespace patchlight::server::result_text_test {
namespace {

TEST(ResultText, ListsOfNumbersStandOnOneLine) {
    const nlohmann::ordered_json result{{"name", "a \"b\""},
                                        {"colour", {1, 2.5, 3}},
                                        {"list", {{{"x", true}}}},
                                        {"none", nlohmann::ordered_json::array()}};
    EXPECT_EQ(result_text(result), R"({
  "name": "a \"b\"",
  "colour": [1,2.5,3],
  "list": [
    {
      "x": true
    }
  ],
  "none": []
}
)");
}

TEST(ResultText, ReadsBackAsTheSame) {
    const auto result = nlohmann::ordered_json::parse(
        R"({"a": [[1, 2], [3.5, "é"]], "b": {"c": {}, "/~": null}, "d": [{}, [], 1e-300]})");
    EXPECT_EQ(nlohmann::ordered_json::parse(result_text(result)), result);
}

}  // namespace
}  // namespace patchlight::server::result_text_test
