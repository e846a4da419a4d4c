#include "server/selftest/selftest_table.h"

#include "server/selftest/known_families.h"
#include "server/selftest/worst_of.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace patchlight::server::selftest_table_test {
namespace {

KnownAnswer answer(double result, double exact, double bound) {
    return {"case, of two", "F", "analytic", result, exact, bound};
}

TEST(SelftestTable, AnAnswerAtItsBoundPassesAndBeyondFails) {
    EXPECT_TRUE(answer(1.5, 1.0, 0.5).is_within());
    EXPECT_TRUE(answer(0.0, 0.0, 0.0).is_within());
    EXPECT_FALSE(answer(1.5001, 1.0, 0.5).is_within());
    EXPECT_FALSE(answer(0.4999, 1.0, 0.5).is_within());
    EXPECT_FALSE(answer(1e-300, 0.0, 0.0).is_within()) << "a leak may be small, and is one";
}

TEST(SelftestTable, WhatIsNoNumberFails) {
    EXPECT_FALSE(answer(std::nan(""), 1.0, 0.5).is_within());
    EXPECT_FALSE(answer(1.0, 1.0, std::nan("")).is_within());
    EXPECT_FALSE(answer(INFINITY, 1.0, 0.5).is_within());
}

TEST(SelftestTable, OneWrongAnswerSpoilsTheVerdict) {
    std::vector<KnownAnswer> answers{answer(1.0, 1.0, 0.1), answer(2.0, 2.05, 0.1)};
    EXPECT_TRUE(all_within(answers));
    EXPECT_TRUE(selftest_verdict(answers, 1.0).starts_with("passed: 2 of 2 answers"));
    answers[1].exact = 2.2;
    EXPECT_FALSE(all_within(answers));
    EXPECT_TRUE(selftest_verdict(answers, 1.0).starts_with("FAILED: 1 of 2 answers"));
    EXPECT_NE(selftest_line(answers[1]).find("OUT OF BOUND"), std::string::npos);
    EXPECT_EQ(selftest_line(answers[0]).find("OUT OF BOUND"), std::string::npos);
}

TEST(SelftestTable, NoAnswersAreNoPass) { EXPECT_FALSE(all_within({})); }

/// A case of the suite whose exact value is taken for another's: the bound is tight enough to tell.
TEST(SelftestTable, AWrongExactValueIsFound) {
    std::vector<KnownAnswer> answers;
    AnswerSheet sheet([&](const KnownAnswer& each) { answers.push_back(each); }, {});
    answer_plates(sheet);
    EXPECT_TRUE(all_within(answers));
    constexpr double wrong = 1.05;  // times the exact value
    for (KnownAnswer& each : answers) {
        if (each.exact == 0.0) continue;
        each.exact *= wrong;
        EXPECT_FALSE(each.is_within()) << each.name << " " << each.method;
    }
    EXPECT_FALSE(all_within(answers));
}

TEST(SelftestTable, TheCsvHasAllColumnsInEachRow) {
    std::vector<KnownAnswer> answers{answer(1.0, 1.25, 0.5), answer(2.0, 1.0, 0.5)};
    answers[1].published = 1.01;
    std::string csv;
    write_selftest_csv(answers, [&](std::string_view text) { csv += text; });
    EXPECT_EQ(csv,
              "case,quantity,method,result,exact,published,error,bound,seconds,within\n"
              "\"case, of two\",F,analytic,1,1.25,,-0.25,0.5,0,true\n"
              "\"case, of two\",F,analytic,2,1,1.01,1,0.5,0,false\n");
}

TEST(SelftestTable, TheJsonSaysTheSame) {
    const std::vector<KnownAnswer> answers{answer(1.0, 1.25, 0.5), answer(2.0, 1.0, 0.5)};
    std::string text;
    write_selftest_json(answers, 2.5, [&](std::string_view piece) { text += piece; });
    const auto json = nlohmann::json::parse(text);
    EXPECT_FALSE(json["within"].get<bool>());
    EXPECT_EQ(json["seconds"], 2.5);
    ASSERT_EQ(json["answers"].size(), 2u);
    EXPECT_EQ(json["answers"][0]["error"], -0.25);
    EXPECT_TRUE(json["answers"][0]["within"].get<bool>());
    EXPECT_FALSE(json["answers"][0].contains("published"));
}

TEST(SelftestTable, TheWorstIsTheOneNearestToItsBound) {
    const std::vector<KnownAnswer> answers{answer(1.4, 1.0, 1.0), answer(1.2, 1.0, 0.3),
                                           answer(1.0, 1.0, 0.0)};
    EXPECT_EQ(worst_of(answers).result, 1.2);
    EXPECT_EQ(worst_of(answers).quantity, "F, worst of 3");
    const std::vector<KnownAnswer> with_wrong{answer(1.2, 1.0, 0.3), answer(1.01, 1.0, 0.0)};
    EXPECT_EQ(worst_of(with_wrong).result, 1.01);
}

}  // namespace
}  // namespace patchlight::server::selftest_table_test
