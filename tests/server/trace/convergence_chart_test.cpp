#include "server/trace/convergence_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

namespace patchlight::server::convergence_chart_test {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(ConvergenceChart, HasAPointForEachStepAndCurve) {
    const std::vector<ConvergenceStep> shots{
        {1, 0.1, 1.0, 0.9}, {10, 0.2, 0.1, 0.2}, {100, 0.3, 0.003, 0.01}};
    const std::string svg = convergence_svg(shots, "shots");
    EXPECT_EQ(count_of(svg, "<circle"), 6u);
    EXPECT_EQ(count_of(svg, "<polyline"), 2u);
    EXPECT_NE(svg.find("share unshot"), std::string::npos);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(ConvergenceChart, StepsWithoutLightAndNoStepsAtAllAreDrawable) {
    for (const std::vector<ConvergenceStep>& steps :
         {std::vector<ConvergenceStep>{}, {{1, 0.1, 0.0}}, {{1, 0.1, 0.5}}}) {
        const std::string svg = convergence_svg(steps, "sweeps");
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
        EXPECT_TRUE(svg.ends_with("</svg>\n"));
    }
}

TEST(ConvergenceChart, AHundredfoldFallIsTwoDecadesDeep) {
    const std::vector<ConvergenceStep> sweeps{{1, 0.1, 1.0}, {2, 0.2, 0.1}, {3, 0.3, 0.01}};
    std::istringstream svg(convergence_svg(sweeps, "sweeps"));
    std::vector<double> heights;
    for (std::string line; std::getline(svg, line);)
        if (const auto at = line.find("cy=\""); at != std::string::npos)
            heights.push_back(std::stod(line.substr(at + 4)));
    ASSERT_EQ(heights.size(), 3u);
    constexpr double rounding = 0.11;  // of coordinates, to tenths of a pixel
    EXPECT_NEAR(heights[2] - heights[1], heights[1] - heights[0], rounding);
    EXPECT_GT(heights[1], heights[0] + 10.0);
}

TEST(ConvergenceChart, TheCsvLeavesUnshotEmptyWhereThereIsNone) {
    const std::vector<ConvergenceStep> steps{{1, 0.5, 0.25}, {2, 1.0, 0.125, 0.75}};
    std::string csv;
    write_convergence_csv(steps, [&](std::string_view text) { csv += text; });
    EXPECT_EQ(csv, "iteration,seconds,residual,unshot\n1,0.5,0.25,\n2,1,0.125,0.75\n");
}

}  // namespace
}  // namespace patchlight::server::convergence_chart_test
