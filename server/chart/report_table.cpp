#include "server/chart/report_table.h"

#include "server/chart/html_text.h"
#include "server/chart/report_figures.h"
#include "server/summary.h"
#include "server/wording.h"

namespace patchlight::server {
namespace {

std::string cell(const std::string& text) { return "<td>" + html_text(text) + "</td>"; }

std::string effort_of(const SolveSettings& settings) {
    if (settings.accuracy) return "accuracy " + number_text(*settings.accuracy);
    if (settings.rays) return std::to_string(*settings.rays) + " rays";
    if (settings.hemicube_resolution)
        return "hemicube " + std::to_string(*settings.hemicube_resolution);
    return "";
}

std::string row_of(const ChartPoint& point) {
    const auto share = [](const std::optional<double>& value) {
        return value ? percent(*value) : std::string("–");
    };
    return std::string(point.is_on_front ? "<tr class=\"front\">" : "<tr>") +
           cell(all_series[point.method.series].name) + cell(effort_of(point.method.settings)) +
           cell(std::to_string(point.patches)) + cell(rounded(point.seconds)) +
           cell(std::to_string(point.repeats)) +
           cell(share(point.error) + (point.is_at_floor ? " *" : "")) +
           cell(share(point.estimate)) + cell(point.is_on_front ? "front" : "") + "</tr>\n";
}

}  // namespace

std::string points_table(const Chart& chart) {
    if (chart.points.empty()) return "<p>Nothing was measured in the time there was.</p>\n";
    std::string html =
        "<table>\n<thead><tr><th>method</th><th>effort</th><th>patches</th><th>seconds</th>"
        "<th>repeats</th><th>true error</th><th>its estimate</th><th></th></tr></thead>\n<tbody>\n";
    bool is_any_at_floor = false;
    for (const ChartPoint& point : chart.points) {
        html += row_of(point);
        is_any_at_floor = is_any_at_floor || point.is_at_floor;
    }
    html += "</tbody></table>\n";
    if (is_any_at_floor)
        html += "<p>* at the floor: less than twice the reference's own error.</p>\n";
    return html;
}

std::string skipped_table(const Chart& chart) {
    if (chart.skipped.empty()) return "";
    std::string html =
        "<h2>Skipped</h2>\n<table class=\"skipped\">\n<thead><tr><th>method</th><th>effort</th>"
        "<th>patches</th><th>why</th></tr></thead>\n<tbody>\n";
    for (const SkippedMethod& skipped : chart.skipped)
        html += "<tr>" + cell(all_series[skipped.method.series].name) +
                cell(effort_of(skipped.method.settings)) +
                cell(std::to_string(skipped.method.cost.patches)) + cell(skipped.why) + "</tr>\n";
    return html + "</tbody></table>\n";
}

}  // namespace patchlight::server
