#include "server/chart/report_figures.h"

#include "raster/image_file.h"
#include "server/chart/chart_selection.h"
#include "server/chart/chart_view.h"
#include "server/chart/html_text.h"
#include "server/http/base64.h"
#include "server/summary.h"

namespace patchlight::server {
namespace {

std::string image_of(const raster::Image& image, double exposure, const std::string& what) {
    return "<img src=\"data:image/png;base64," + base64(raster::encode_png(image, exposure)) +
           "\" width=\"" + std::to_string(image.width) + "\" height=\"" +
           std::to_string(image.height) + "\" alt=\"" + html_text(what) + "\">";
}

std::string caption(const std::string& head, const std::string& body) {
    return "<figcaption><b>" + html_text(head) + "</b><br>" + html_text(body) + "</figcaption>";
}

std::string figure_of(const Chart& chart, const Selected& each, bool has_map,
                      const std::string& otherwise) {
    const std::string name = all_series[each.series].name;
    if (!each.point) return "<figure class=\"none\">" + caption(name, otherwise) + "</figure>\n";
    const ChartPoint& point = *each.point;
    const ChartReference& reference = *chart.reference;
    std::string figure = "<figure>" + image_of(point.view.picture, reference.exposure, name);
    if (has_map)
        figure +=
            image_of(error_map(point.view.reflected, reference.view.reflected, reference.level),
                     0.0, "errors of " + name);
    return figure +
           caption(name, setting_text(point.method) + ": " + percent(*point.error) + " in " +
                             rounded(point.seconds) + " s") +
           "</figure>\n";
}

/// With a number at each decade.
std::string scale() {
    constexpr int width = 256, height = 12;
    return "<div class=\"scale\">" +
           image_of(error_scale(width, height), 0.0, "colours of errors") +
           "<div class=\"ticks\"><span>≤ 0.1 %</span><span>1 %</span><span>10 %</span>"
           "<span>≥ 100 %</span></div></div>\n";
}

}  // namespace

std::string percent(double share) { return rounded(100.0 * share) + " %"; }

std::string equal_time_figures(const Chart& chart) {
    const std::optional<double> seconds = middle_time(chart);
    if (!chart.reference || !seconds) return "";
    const bool has_maps = !chart.reference->is_at_sensors;
    std::string html =
        "<h2>In equal time</h2>\n<p>The least error of each method within " + rounded(*seconds) +
        " s, the time <code>auto</code> takes at its middle accuracy" +
        (has_maps
             ? ". Below each picture, where its field is wrong: |Y(B̃ − B)| in parts of the level "
               "of the light sent back, √(∫ Y(B − E)² dA / ∫ dA), on one scale for all."
             : ".") +
        "</p>\n" + (has_maps ? scale() : "") + "<div class=\"pictures\">\n<figure>" +
        image_of(chart.reference->view.picture, chart.reference->exposure, "the reference") +
        caption("reference", chart.reference->is_known
                                 ? std::string("the known answer")
                                 : "accuracy " + rounded(chart.reference->accuracy) + " in " +
                                       rounded(chart.reference->seconds) + " s") +
        "</figure>\n";
    for (const Selected& each : best_within_time(chart, *seconds))
        html += figure_of(chart, each, has_maps, "takes longer at its coarsest");
    return html + "</div>\n";
}

std::string equal_error_figures(const Chart& chart) {
    if (!chart.reference || !middle_time(chart)) return "";
    const double error = common_error(chart);
    std::string html = "<h2>At equal error</h2>\n<p>The quickest of each method with an error of " +
                       percent(error) + " at most.</p>\n<div class=\"pictures\">\n";
    constexpr bool no_map = false;
    for (const Selected& each : quickest_within_error(chart, error))
        html += figure_of(chart, each, no_map, "does not come so far in the time there was");
    return html + "</div>\n";
}

}  // namespace patchlight::server
