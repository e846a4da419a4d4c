#include "server/chart/gnuplot_script.h"

#include "server/chart/pareto_front.h"
#include "server/summary.h"
#include "server/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace patchlight::server {
namespace {

constexpr double least_drawn = 1e-4;  // an error of 0 has no place on a logarithmic axis [%]

struct Style {
    const char* colour;
    int mark;          // gnuplot's point type
    const char* dash;  // gnuplot's dash type
};

/// Of all_series, in order. Squares are analytic, triangles ray-cast, diamonds hemicube; filled
/// ones Gauss–Seidel, hollow ones shooting.
constexpr std::array styles{Style{"#000000", 7, "solid"},      Style{"#0072B2", 5, "(12,4)"},
                            Style{"#009E73", 9, "(6,4)"},      Style{"#D55E00", 13, "(2,3)"},
                            Style{"#56B4E9", 4, "(12,4,2,4)"}, Style{"#E69F00", 8, "(6,4,2,4)"},
                            Style{"#CC79A7", 12, "(2,6)"}};
static_assert(styles.size() == all_series.size());

constexpr const char* svg_terminal =
    "set terminal svg size 880,600 fixed font 'Helvetica,Arial,sans-serif,14' background "
    "'#ffffff' linewidth 1.2\n";
constexpr const char* png_terminal =
    "set terminal pngcairo size 1320,900 font 'sans,16' background '#ffffff' linewidth 1.8 "
    "pointscale 1.5\n";

/// A text in single quotes, in which gnuplot substitutes nothing.
std::string quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        quoted += is_control ? " " : c == '\'' ? "''" : std::string(1, c);
    }
    return quoted + "'";
}

/// [%]
double drawn_error(const SpeedAndError& point) {
    return std::max(100.0 * point.error, least_drawn);
}

std::string row(const SpeedAndError& point) {
    return number_text(point.seconds) + " " + number_text(drawn_error(point)) + "\n";
}

/// The rows of one set of points, and after a gap those of its front.
std::string block(const std::string& name, const std::vector<SpeedAndError>& points) {
    std::string text = "$" + name + " << EOD\n";
    for (const SpeedAndError& point : points) text += row(point);
    text += "\n\n";
    for (const std::size_t k : pareto_front(points)) text += row(points[k]);
    return text + "EOD\n";
}

std::vector<SpeedAndError> points_of(const Chart& chart, std::optional<SeriesIndex> series) {
    std::vector<SpeedAndError> points;
    for (const ChartPoint& point : chart.points)
        if (point.error && (!series || point.method.series == *series))
            points.push_back({point.seconds, *point.error});
    return points;
}

/// An axis between round numbers, 1, 2 or 5 times a power of ten, with all of them marked.
std::string axis(const std::string& name, double least, double most) {
    constexpr double margin = 1.15;  // between the outermost points and the frame [1]
    std::vector<double> ticks{std::pow(10.0, std::floor(std::log10(least / margin)))};
    for (std::size_t k = 1; ticks.back() < most * margin; ++k)
        ticks.push_back(ticks.back() * (k % 3 == 2 ? 2.5 : 2.0));
    while (ticks.size() > 2 && ticks[1] <= least / margin) ticks.erase(ticks.begin());
    std::string text = "set " + name + "range [" + rounded(ticks.front()) + ":" +
                       rounded(ticks.back()) + "]\nset " + name + "tics (";
    for (const double tick : ticks) text += (tick > ticks.front() ? ", " : "") + rounded(tick);
    return text + ")\n";
}

std::string ranges(const Chart& chart) {
    const std::vector<SpeedAndError> points = points_of(chart, {});
    if (points.empty()) return axis("x", 0.01, 100.0) + axis("y", 0.1, 100.0);
    const auto floor = chart.reference ? chart.reference->estimate : std::nullopt;
    double quickest = points.front().seconds, slowest = quickest;
    double least = floor ? 100.0 * *floor : drawn_error(points.front()), most = least;
    for (const SpeedAndError& point : points) {
        quickest = std::min(quickest, point.seconds);
        slowest = std::max(slowest, point.seconds);
        least = std::min(least, drawn_error(point));
        most = std::max(most, drawn_error(point));
    }
    return axis("x", quickest, slowest) + axis("y", least, most);
}

std::string plot_command(const Chart& chart) {
    std::string plots;
    const auto add = [&](const std::string& plot) {
        plots += (plots.empty() ? "plot " : ", \\\n     ") + plot;
    };
    if (chart.reference && chart.reference->estimate)
        add(number_text(100.0 * *chart.reference->estimate) +
            " with lines lc rgb '#888888' lw 1 dt (3,3) title 'error of the reference'");
    if (!points_of(chart, {}).empty())
        add("$all index 1 with steps lc rgb '#cccccc' lw 5 title 'front'");
    for (SeriesIndex s = 0; s < all_series.size(); ++s) {
        if (points_of(chart, s).empty()) continue;
        const std::string name = "$series" + std::to_string(s);
        const std::string colour = std::string(" lc rgb '") + styles[s].colour + "'";
        add(name + " index 1 with lines lw 1.3 dt " + styles[s].dash + colour + " notitle");
        add(name + " index 0 with points lw 1.5 ps 1 pt " + std::to_string(styles[s].mark) +
            colour + " notitle");
        add("keyentry with linespoints lw 1.3 dt " + std::string(styles[s].dash) + " pt " +
            std::to_string(styles[s].mark) + " ps 1" + colour + " title " +
            quoted(all_series[s].name));
    }
    return (plots.empty() ? "plot NaN notitle" : plots) + "\n";
}

/// Everything but where it goes to.
std::string settings(const Chart& chart, const std::string& title) {
    const bool at_sensors = chart.reference && chart.reference->is_at_sensors;
    std::string text = "set title " + quoted(title) + " noenhanced\n" +
                       "set xlabel 'time of the solve [s]'\n" + "set ylabel 'true error of the " +
                       (at_sensors ? "irradiance at sensors" : "displayed field") + " [%]'\n" +
                       "set logscale xy\nset format '%g'\n"
                       "set grid lc rgb '#d8d8d8' lw 0.6 dt solid\n"
                       "set border 3 lc rgb '#444444'\nset tics nomirror\n"
                       "set key outside right top Left reverse samplen 3 spacing 1.25\n" +
                       ranges(chart);
    if (const auto points = points_of(chart, {}); !points.empty()) text += block("all", points);
    for (SeriesIndex s = 0; s < all_series.size(); ++s)
        if (const auto points = points_of(chart, s); !points.empty())
            text += block("series" + std::to_string(s), points);
    return text;
}

constexpr const char* encoding = "set encoding utf8\n";

}  // namespace

std::string gnuplot_script(const Chart& chart, const std::string& title, Plot plot) {
    return std::string(encoding) + (plot == Plot::svg ? svg_terminal : png_terminal) +
           settings(chart, title) + plot_command(chart);
}

std::string gnuplot_script(const Chart& chart, const std::string& title) {
    return "# Draws chart.svg and chart.png anew, where it is run: gnuplot chart.gp\n" +
           std::string(encoding) + settings(chart, title) + svg_terminal +
           "set output 'chart.svg'\n" + plot_command(chart) + png_terminal +
           "set output 'chart.png'\nreplot\n";
}

}  // namespace patchlight::server
