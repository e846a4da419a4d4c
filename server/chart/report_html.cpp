#include "server/chart/report_html.h"

#include "server/chart/chart_selection.h"
#include "server/chart/html_text.h"
#include "server/chart/report_figures.h"
#include "server/chart/report_table.h"
#include "server/summary.h"

#include <cmath>

namespace patchlight::server {
namespace {

constexpr const char* style = R"(
:root { color: #1a1a1a; background: #fff; font: 16px/1.5 Georgia, "Times New Roman", serif; }
body { max-width: 58rem; margin: 2.5rem auto; padding: 0 1.25rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .6rem; font-weight: normal; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .5rem; font-weight: normal; }
p { max-width: 42rem; margin: .5rem 0; }
code { font-size: .88em; overflow-wrap: anywhere; }
svg { width: 100%; height: auto; margin: 1rem 0; }
.pictures { display: flex; flex-wrap: wrap; gap: 1.1rem; margin: 1rem 0; }
figure { margin: 0; width: 160px; break-inside: avoid; }
figure img { display: block; margin-bottom: 3px; max-width: 100%; height: auto; }
figcaption { font-size: .78rem; line-height: 1.3; margin-top: .3rem; }
.none { color: #666; }
.scale { width: 256px; font-size: .75rem; margin: .8rem 0; }
.scale img { display: block; }
.ticks { position: relative; height: 1.3em; }
.ticks span { position: absolute; transform: translateX(-50%); white-space: nowrap; }
.ticks span:nth-child(1) { left: 0; transform: none; }
.ticks span:nth-child(2) { left: 33.3%; }
.ticks span:nth-child(3) { left: 66.7%; }
.ticks span:nth-child(4) { left: 100%; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; margin: .8rem 0; }
th, td { text-align: right; padding: .12rem .7rem .12rem 0; border-bottom: 1px solid #e4e4e4; }
th { font-weight: normal; font-style: italic; border-bottom: 1px solid #888; }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2), .skipped td:last-child, .skipped th:last-child { text-align: left; }
.front { font-weight: bold; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
@media print { :root { font-size: 10.5pt; } body { margin: 0; max-width: none; } h2 { break-after: avoid; } }
)";

std::string reference_sentence(const ChartReference& reference) {
    if (reference.is_known)
        return "They are measured against the exact answer, which is known: all surfaces are "
               "alike and no light is lost, so B = E / (1 − ρ).";
    std::string text = "They are measured against a solve to the accuracy " +
                       rounded(reference.accuracy) + " with other random numbers, which took " +
                       rounded(reference.seconds) + " s";
    if (reference.estimate)
        text += " and estimates its own error at " + percent(*reference.estimate) +
                ", the floor of the chart; what lies near it is no better than that";
    return text + ".";
}

std::string measure_sentence(const ChartReference& reference) {
    return reference.is_at_sensors
               ? "Nothing in this scene reflects, so errors are those of the irradiance at its "
                 "sensors: the largest, relative to the largest irradiance."
               : "Errors are those of the field that pictures show, √(∫ Y(B̃ − B)² dA / "
                 "∫ Y(B − E)² dA) over all fronts, at 16384 points.";
}

std::string facts(const Chart& chart, const ChartOrigin& origin) {
    std::string html = "<p>" + std::to_string(chart.points.size()) +
                       " ways to solve this scene, measured in " + rounded(chart.seconds) +
                       " s by Patchlight " + html_text(origin.version) + " on " +
                       std::to_string(chart.threads) + " threads" +
                       (origin.processor.empty() ? "" : " of " + html_text(origin.processor)) +
                       (chart.is_interrupted ? "; interrupted, so not all there could be" : "") +
                       ". Times are those of solving alone: no loading, no drawing, and not what "
                       "hand-set solves spend on measuring their own error for the report. Below "
                       "a second they are medians of 3.</p>\n";
    if (chart.reference)
        html += "<p>" + html_text(measure_sentence(*chart.reference)) + " " +
                html_text(reference_sentence(*chart.reference)) + "</p>\n";
    if (const std::string lesson = automatic_lesson(chart); !lesson.empty())
        html += "<p>" + html_text(lesson) + "</p>\n";
    return html + "<p><code>" + html_text(origin.command) + "</code></p>\n";
}

/// Without what comes before the element: a page has a head of its own.
std::string inline_svg(const std::string& svg) {
    const std::size_t begin = svg.find("<svg");
    return begin == std::string::npos ? "" : svg.substr(begin);
}

}  // namespace

std::string automatic_lesson(const Chart& chart) {
    const AutomaticScore score = score_automatic(chart);
    if (score.points == 0) return "";
    std::string text = "auto is on the front at " + std::to_string(score.on_front) + " of " +
                       std::to_string(score.points) + " accuracies.";
    if (score.unmatched > 0)
        text += " At " + std::to_string(score.unmatched) +
                " of them nothing set by hand came to as little error in the time there was.";
    if (score.most_gain > 0.0) {
        text += " Otherwise the quickest hand-set method that errs no more took ";
        text += rounded(score.least_gain);
        if (score.most_gain > score.least_gain) text += " to " + rounded(score.most_gain);
        text += " times as long.";
    }
    return text;
}

std::string report_html(const Chart& chart, const ChartOrigin& origin, const std::string& svg,
                        const std::string& why_no_chart) {
    const std::string title = "Speed against accuracy: " + html_text(origin.scene);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           title + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + title +
           "</h1>\n" + facts(chart, origin) +
           (svg.empty() ? "<p>The chart is not drawn: " + html_text(why_no_chart) + ".</p>\n"
                        : inline_svg(svg)) +
           equal_time_figures(chart) + equal_error_figures(chart) + "<h2>All methods</h2>\n" +
           points_table(chart) + skipped_table(chart) + "</body>\n</html>\n";
}

}  // namespace patchlight::server
