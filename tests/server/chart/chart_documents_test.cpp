#include "server/chart/chart_csv.h"
#include "server/chart/chart_json.h"
#include "server/chart/gnuplot_script.h"
#include "server/chart/report_html.h"
#include "tests/server/chart/charts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::server::chart_documents_test {
namespace {

const ChartOrigin origin{"a <b> & \"c\".json", "patchlight chart 'a <b>'", "Some CPU", 8, "1.2.3"};

std::string csv(const Chart& chart) {
    std::string text;
    write_chart_csv(chart, [&](std::string_view piece) { text += piece; });
    return text;
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ChartCsv, HasARowForEveryMethodMeasuredOrNot) {
    const std::string text = csv(small_chart());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 6 + 1);
    EXPECT_TRUE(holds(text, "\ngauss-seidel,analytic,,0.25,256,,100,0.05,3,0.125,0.08,no,yes,\n"));
    EXPECT_TRUE(holds(text, "\nauto,auto,0.001,,,,100,4,3,,9e-04,yes,yes,\n")) << text;
    EXPECT_TRUE(holds(text,
                      "\ngauss-seidel,hemicube,,0.25,,128,0,,,,,,,"
                      "\"would have taken long, very long\"\n"))
        << text;
}

TEST(ChartCsv, EveryRowHasAsManyFieldsAsTheHeader) {
    Chart chart = small_chart();
    chart.skipped[0].why = "plain";
    std::string text = csv(chart);
    const auto commas = [](const std::string& line) {
        return std::count(line.begin(), line.end(), ',');
    };
    const auto expected = commas(text.substr(0, text.find('\n')));
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
        EXPECT_EQ(commas(text.substr(0, end)), expected) << text.substr(0, end);
}

TEST(ChartJson, SaysWhatWasMeasuredWhereAndAgainstWhat) {
    const nlohmann::ordered_json document = chart_json(small_chart(), origin);
    EXPECT_EQ(document["status"], "complete");
    EXPECT_EQ(document["machine"]["processor"], "Some CPU");
    EXPECT_EQ(document["machine"]["threads"], 2);
    EXPECT_EQ(document["reference"]["estimate"], 0.0008);
    ASSERT_EQ(document["points"].size(), 6u);
    EXPECT_EQ(document["points"][0]["rays"], 256);
    EXPECT_EQ(document["points"][0]["on_front"], true);
    EXPECT_FALSE(document["points"][1].contains("estimate"));
    EXPECT_EQ(document["points"][5]["at_floor"], true);
    EXPECT_EQ(document["skipped"][0]["why"], "would have taken long, very long");
}

TEST(ChartJson, AKnownAnswerHasNoErrorOfItsOwn) {
    Chart chart = small_chart();
    chart.reference->is_known = true;
    chart.is_interrupted = true;
    const nlohmann::ordered_json document = chart_json(chart, origin);
    EXPECT_EQ(document["reference"], (nlohmann::ordered_json{{"kind", "known answer"}}));
    EXPECT_EQ(document["status"], "cancelled");
}

TEST(GnuplotScript, DrawsEverySeriesThatHasPointsAndTheFloor) {
    const std::string script = gnuplot_script(small_chart(), "a scene", Plot::svg);
    EXPECT_TRUE(holds(script, "title 'auto'"));
    EXPECT_TRUE(holds(script, "title 'gauss-seidel, ray-cast'"));
    EXPECT_FALSE(holds(script, "title 'shooting"));
    EXPECT_TRUE(holds(script, "\n0.05 8\n"));  // seconds and percent
    EXPECT_TRUE(holds(script, "0.08 with lines"));
    EXPECT_FALSE(holds(script, "set output"));
}

TEST(GnuplotScript, NothingInATitleIsCarriedOut) {
    const std::string script =
        gnuplot_script(small_chart(), "it's `date`\nset output 'x'", Plot::svg);
    EXPECT_TRUE(holds(script, "set title 'it''s `date` set output ''x''' noenhanced\n"));
}

TEST(GnuplotScript, AnErrorOfZeroHasAPlaceOnTheLogarithmicAxis) {
    Chart chart = small_chart();
    chart.points[5].error = 0.0;
    EXPECT_TRUE(holds(gnuplot_script(chart, "", Plot::svg), "\n4 1e-04\n"));
}

TEST(ReportHtml, HoldsChartPicturesTableAndWhatWasSkipped) {
    const std::string page = report_html(small_chart(), origin, "<?xml?><svg id=\"it\"/>", "");
    EXPECT_TRUE(holds(page, "<svg id=\"it\"/>"));
    EXPECT_FALSE(holds(page, "<?xml"));
    EXPECT_TRUE(holds(page, "In equal time"));
    EXPECT_TRUE(holds(page, "At equal error"));
    EXPECT_TRUE(holds(page, "data:image/png;base64,iVBOR"));
    EXPECT_TRUE(holds(page, "would have taken long, very long"));
    EXPECT_TRUE(holds(page, "auto is on the front at 3 of 3 accuracies. At 2 of them nothing"));
    EXPECT_TRUE(holds(page, "Some CPU"));
}

TEST(ReportHtml, AsksForNothingAndRunsNothing) {
    const std::string page = report_html(small_chart(), origin, "<svg/>", "");
    for (const char* reaching_out : {"http://", "https://", "<script", "<link", "url("})
        EXPECT_FALSE(holds(page, reaching_out)) << reaching_out;
}

TEST(ReportHtml, NamesAreTextAndNothingElse) {
    const std::string page = report_html(small_chart(), origin, "", "gnuplot is not installed");
    EXPECT_FALSE(holds(page, "<b> &"));
    EXPECT_TRUE(holds(page, "a &lt;b&gt; &amp; &quot;c&quot;.json"));
    EXPECT_TRUE(holds(page, "The chart is not drawn: gnuplot is not installed."));
}

TEST(ReportHtml, WithoutAReferenceThereIsAPageToo) {
    Chart chart;
    chart.is_interrupted = true;
    const std::string page = report_html(chart, origin, "", "nothing");
    EXPECT_TRUE(holds(page, "interrupted"));
    EXPECT_TRUE(holds(page, "Nothing was measured"));
}

}  // namespace
}  // namespace patchlight::server::chart_documents_test
