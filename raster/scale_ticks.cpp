#include "raster/scale_ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace patchlight::raster {
namespace {

constexpr double rounding = 1e-9;  // of a step: what is so near to a tick lies on it [1]

struct Step {
    double width = 1.0;
    int decimals = 0;  // that its multiples need
};

Step step_number(int k, int decade) {
    constexpr std::array<double, 4> widths{1.0, 2.0, 2.5, 5.0};
    const double width = widths[static_cast<std::size_t>(k)];
    const int more = width == 2.5 ? 1 : 0;
    return {width * std::pow(10.0, decade), std::max(0, more - decade)};
}

double first_multiple(double least, double width) { return std::ceil(least / width - rounding); }
double last_multiple(double most, double width) { return std::floor(most / width + rounding); }

Step fitting_step(double least, double most, int most_ticks) {
    const int decade = static_cast<int>(std::floor(std::log10((most - least) / most_ticks))) - 1;
    for (int power = decade;; ++power)
        for (int k = 0; k < 4; ++k) {
            const Step step = step_number(k, power);
            const double count =
                last_multiple(most, step.width) - first_multiple(least, step.width) + 1.0;
            if (count <= most_ticks) return step;
        }
}

std::string label(double place, const Step& step, double largest) {
    constexpr int most_decimals = 4;
    constexpr double longest = 1e6;
    std::array<char, 48> text{};
    const bool is_plain = step.decimals <= most_decimals && largest < longest;
    std::snprintf(text.data(), text.size(), is_plain ? "%.*f" : "%.*g",
                  is_plain ? step.decimals : 4, place);
    return text.data();
}

}  // namespace

std::vector<Tick> scale_ticks(double least, double most, int most_ticks) {
    const Step step = fitting_step(least, most, std::max(2, most_ticks));
    const double largest = std::max(std::abs(least), std::abs(most));
    std::vector<Tick> ticks;
    for (double k = first_multiple(least, step.width); k <= last_multiple(most, step.width); ++k)
        ticks.push_back({k * step.width, label(k * step.width + 0.0, step, largest)});
    return ticks;
}

double round_number_above(double number) {
    constexpr std::array<double, 10> round{1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    const double decade = std::pow(10.0, std::floor(std::log10(number)));
    for (const double each : round)
        if (each * decade >= number * (1.0 - rounding)) return each * decade;
    return 10.0 * decade;
}

}  // namespace patchlight::raster
