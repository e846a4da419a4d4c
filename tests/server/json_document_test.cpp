#include "server/json_document.h"

#include <gtest/gtest.h>

#include <string>

namespace patchlight::server::json_document_test {
namespace {

struct Refusal {
    std::string pointer;
    std::string detail;
    std::size_t line = 0;
    std::size_t column = 0;
};

Refusal refusal(std::string_view bytes, const JsonLimits& limits = {}) {
    try {
        parse_json(bytes, limits);
    } catch (const JsonError& error) {
        return {error.pointer(), error.what(), error.line(), error.column()};
    }
    ADD_FAILURE() << "accepted: " << bytes.substr(0, 100);
    return {};
}

void expect_refused(std::string_view bytes, const std::string& words) {
    const Refusal refused = refusal(bytes);
    EXPECT_NE(refused.detail.find(words), std::string::npos) << refused.detail;
}

TEST(JsonDocument, SyntaxErrorsAreToldByLineAndColumn) {
    const Refusal refused = refusal("{\n  \"a\": 1,\n  \"b\": tru\n}");
    EXPECT_EQ(refused.line, 3u);
    EXPECT_EQ(refused.column, 11u);
    EXPECT_EQ(refused.pointer, "");
}

TEST(JsonDocument, ATruncatedDocumentIsRefusedAtItsEnd) {
    const Refusal refused = refusal(R"({"a":)");
    EXPECT_EQ(refused.line, 1u);
    EXPECT_EQ(refused.column, 6u);
    EXPECT_NE(refused.detail.find("unexpected end of input"), std::string::npos) << refused.detail;
}

TEST(JsonDocument, WhatIsNoJsonIsRefused) {
    expect_refused("", "empty");
    expect_refused(" \n\t", "empty");
    expect_refused("{} {}", "syntax error");
    expect_refused("[1,]", "syntax error");
    expect_refused("{'a': 1}", "syntax error");
    expect_refused("[NaN]", "syntax error");
    expect_refused("[Infinity]", "syntax error");
    expect_refused("[-Infinity]", "syntax error");
    expect_refused("[01]", "syntax error");
    expect_refused("[.5]", "syntax error");
    expect_refused("// note\n{}", "syntax error");
}

TEST(JsonDocument, BytesThatAreNoUtf8AreRefused) {
    expect_refused("[\"\xFF\"]", "ill-formed UTF-8");
    expect_refused("[\"\xC0\xAF\"]", "ill-formed UTF-8");
    expect_refused(R"(["\ud800"])", "surrogate");
    expect_refused(std::string_view("{}\0", 3), "NUL");
    expect_refused(std::string_view("[\"a\0b\"]", 7), "NUL");
    expect_refused(std::string_view("\xFF\xFE[\0]\0", 6), "UTF-16");
}

TEST(JsonDocument, MessagesDoNotQuoteForeignBytes) {
    for (const char byte : refusal("[\"\xFF\"]").detail)
        EXPECT_LT(static_cast<unsigned char>(byte), 0x80);
}

TEST(JsonDocument, AByteOrderMarkIsAllowed) {
    EXPECT_TRUE(parse_json("\xEF\xBB\xBF{}").is_object());
}

TEST(JsonDocument, NumbersADoubleCannotHoldAreRefused) {
    expect_refused(R"({"size": 1e999})", "number out of range");
    expect_refused(R"({"size": -1e999})", "number out of range");
    EXPECT_EQ(parse_json("1e-999").get<double>(), 0.0);
}

TEST(JsonDocument, DuplicateKeysAreRefusedWithTheirPointer) {
    const Refusal refused = refusal(R"({"a": [{"x": 1}, {"b/c": 1, "d": [2], "b/c": 2}]})");
    EXPECT_EQ(refused.pointer, "/a/1/b~1c");
    EXPECT_NE(refused.detail.find("'b/c' is given twice"), std::string::npos) << refused.detail;
}

TEST(JsonDocument, TheSameKeyInTwoObjectsIsFine) {
    EXPECT_EQ(parse_json(R"([{"a": 1}, {"a": 2}])").size(), 2u);
}

TEST(JsonDocument, DepthIsLimited) {
    const auto nested = [](std::size_t depth) {
        return std::string(depth, '[') + std::string(depth, ']');
    };
    EXPECT_TRUE(parse_json(nested(64)).is_array());
    expect_refused(nested(65), "nested deeper than 64 levels");
    expect_refused(std::string(1'000'000, '['), "nested deeper than 64 levels");
}

TEST(JsonDocument, SizeValuesAndKeysAreLimited) {
    JsonLimits limits;
    limits.bytes = 10;
    EXPECT_NE(refusal("[1,2,3,4,5,6]", limits).detail.find("13 bytes; the limit is 10"),
              std::string::npos);
    limits = {};
    limits.values = 3;
    EXPECT_EQ(parse_json("[1,2]", limits).size(), 2u);
    EXPECT_NE(refusal("[1,2,3]", limits).detail.find("more than 3 values"), std::string::npos);
    expect_refused("{\"" + std::string(257, 'k') + "\": 1}", "the limit is 256");
}

TEST(JsonDocument, WhatIsReadIsWhatWasWritten) {
    const auto document = parse_json(R"({"a": [1, -2, 2.5, true, null, "é\n"], "b": {"c": []}})");
    EXPECT_EQ(document.dump(), R"({"a":[1,-2,2.5,true,null,"é\n"],"b":{"c":[]}})");
}

}  // namespace
}  // namespace patchlight::server::json_document_test
