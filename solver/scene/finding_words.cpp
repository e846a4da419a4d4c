#include "solver/scene/finding_words.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace patchlight {

namespace {

std::string printed(const char* format, double number) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

}  // namespace

std::string number_text(double number) { return printed("%.3g", number); }

std::string length_text(double metres) { return number_text(metres) + " m"; }

std::string share_text(double share) { return printed("%.2g", 100.0 * share) + " %"; }

std::string place_text(const Vec3& p, double size) {
    const double step = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size)) - 3.0) : 0.0;
    std::string text = "(";
    for (int axis = 0; axis < 3; ++axis) {
        const double rounded =
            step > 0.0 ? std::round(p[axis] / step) * step + 0.0 : p[axis];  // no -0
        text += (axis > 0 ? ", " : "") + printed("%.12g", rounded);
    }
    return text + ") m";
}

std::string quoted(const std::string& name) { return "'" + name + "'"; }

}  // namespace patchlight
