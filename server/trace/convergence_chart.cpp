#include "server/trace/convergence_chart.h"

#include "raster/scale_ticks.h"
#include "server/csv_table.h"
#include "server/summary.h"

#include <algorithm>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr double left = 70.0, right = 690.0, top = 20.0, bottom = 350.0;  // of the axes [px]

/// Where steps and decades come to lie.
struct Axes {
    double last_step = 1.0;
    double low = -1.0, high = 0.0;  // decades

    double x(double step) const { return left + (right - left) * step / last_step; }
    double y(double decade) const {
        return bottom - (bottom - top) * (decade - low) / (high - low);
    }
};

/// Powers of ten that hold all that is above 0.
Axes axes_of(std::span<const ConvergenceStep> steps) {
    Axes axes;
    bool any = false;
    const auto take = [&](double value) {
        if (!(value > 0.0)) return;
        const double decade = std::log10(value);
        axes.low = any ? std::min(axes.low, std::floor(decade)) : std::floor(decade);
        axes.high = any ? std::max(axes.high, std::ceil(decade)) : std::ceil(decade);
        any = true;
    };
    for (const ConvergenceStep& step : steps) {
        take(step.residual);
        if (step.unshot) take(*step.unshot);
        axes.last_step = std::max(axes.last_step, static_cast<double>(step.iteration));
    }
    if (axes.high <= axes.low) axes.high = axes.low + 1.0;
    return axes;
}

std::string coordinate(double pixels) {
    return std::to_string(static_cast<double>(std::lround(10.0 * pixels)) / 10.0).substr(0, 6);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
    return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor +
           "\">" + text + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2) {
    return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" +
           coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\" stroke=\"#ccc\"/>\n";
}

std::string grid(const Axes& axes) {
    std::string drawn;
    constexpr int most_decades = 12;
    const double stride = std::max(1.0, std::ceil((axes.high - axes.low) / most_decades));
    for (double decade = axes.low; decade <= axes.high; decade += stride)
        drawn += line(left, axes.y(decade), right, axes.y(decade)) +
                 text_at(left - 8, axes.y(decade) + 5, "end", rounded(std::pow(10.0, decade)));
    constexpr int most_ticks = 9;
    for (const raster::Tick& tick : raster::scale_ticks(0.0, axes.last_step, most_ticks))
        drawn += line(axes.x(tick.place), top, axes.x(tick.place), bottom) +
                 text_at(axes.x(tick.place), bottom + 20, "middle", tick.label);
    return drawn;
}

template <class Value>
std::string curve(const Axes& axes, std::span<const ConvergenceStep> steps, const char* colour,
                  const Value& value) {
    std::string points, dots;
    for (const ConvergenceStep& step : steps) {
        const double v = value(step);
        if (!(v > 0.0)) continue;
        const std::string x = coordinate(axes.x(step.iteration)),
                          y = coordinate(axes.y(std::log10(v)));
        points += x + "," + y + " ";
        dots += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"2.5\" fill=\"" + colour + "\"/>\n";
    }
    return "<polyline fill=\"none\" stroke=\"" + std::string(colour) +
           "\" stroke-width=\"1.5\" points=\"" + points + "\"/>\n" + dots;
}

std::string legend(double y, const char* colour, const std::string& text) {
    return "<rect x=\"" + coordinate(right - 190) + "\" y=\"" + coordinate(y - 9) +
           "\" width=\"14\" height=\"10\" fill=\"" + colour + "\"/>\n" +
           text_at(right - 170, y, "start", text);
}

}  // namespace

void write_convergence_csv(std::span<const ConvergenceStep> steps, const TextSink& sink) {
    CsvTable table("iteration,seconds,residual,unshot", sink);
    for (const ConvergenceStep& step : steps) {
        table.number(static_cast<std::size_t>(step.iteration));
        table.number(step.seconds).number(step.residual);
        step.unshot ? table.number(*step.unshot) : table.text("");
        table.end_row();
    }
    table.finish();
}

std::string convergence_svg(std::span<const ConvergenceStep> steps, const std::string& step_name) {
    constexpr const char *first = "#1f5fa8", *second = "#c04a12";
    const Axes axes = axes_of(steps);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 400\" width=\"720\" "
        "height=\"400\" font-family=\"sans-serif\" font-size=\"14\">\n"
        "<rect width=\"720\" height=\"400\" fill=\"#fff\"/>\n";
    svg += grid(axes);
    svg += curve(axes, steps, first, [](const ConvergenceStep& step) { return step.residual; });
    svg += legend(top + 24, first, "residual");
    if (!steps.empty() && steps.back().unshot) {
        svg += curve(axes, steps, second,
                     [](const ConvergenceStep& step) { return step.unshot.value_or(0.0); });
        svg += legend(top + 44, second, "share unshot");
    }
    return svg + text_at(0.5 * (left + right), bottom + 42, "middle", step_name) + "</svg>\n";
}

}  // namespace patchlight::server
