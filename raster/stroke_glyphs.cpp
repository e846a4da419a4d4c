#include "raster/stroke_glyphs.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace patchlight::raster {
namespace {

/// Part of an ellipse, from one angle to the other, counter-clockwise if it grows [degrees].
Stroke arc(double x, double y, double rx, double ry, double from, double to) {
    constexpr int pieces = 24;
    Stroke stroke;
    for (int k = 0; k <= pieces; ++k) {
        const double angle = (from + (to - from) * k / pieces) * std::numbers::pi / 180.0;
        stroke.emplace_back(x + rx * std::cos(angle), y + ry * std::sin(angle));
    }
    return stroke;
}

Stroke oval(double x, double y, double rx, double ry) { return arc(x, y, rx, ry, 0.0, 360.0); }

/// One stroke after the other without lifting the pen.
Stroke joined(Stroke first, const Stroke& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

using Glyphs = std::map<std::string, Glyph, std::less<>>;

Glyphs digits() {
    constexpr double w = 0.56;
    const Stroke six_stem = arc(0.52, 0.31, 0.52, 0.69, 180, 100);
    const Stroke nine_stem = arc(0.04, 0.69, 0.52, 0.69, 0, -80);
    return {
        {"0", {w, {oval(0.28, 0.5, 0.28, 0.5)}}},
        {"1", {w, {{{0.1, 0.8}, {0.34, 1}, {0.34, 0}}}}},
        {"2", {w, {joined(arc(0.28, 0.72, 0.27, 0.28, 170, -38), {{0, 0}, {0.56, 0}})}}},
        {"3", {w, {arc(0.27, 0.76, 0.24, 0.24, 155, -90), arc(0.27, 0.26, 0.28, 0.26, 90, -155)}}},
        {"4", {w, {{{0.42, 0}, {0.42, 1}, {0, 0.27}, {0.57, 0.27}}}}},
        {"5",
         {w, {joined({{0.5, 1}, {0.1, 1}, {0.06, 0.54}}, arc(0.27, 0.33, 0.29, 0.33, 136, -150))}}},
        {"6", {w, {oval(0.28, 0.31, 0.28, 0.31), six_stem}}},
        {"7", {w, {{{0, 1}, {0.56, 1}, {0.2, 0}}}}},
        {"8", {w, {oval(0.28, 0.76, 0.235, 0.24), oval(0.28, 0.26, 0.28, 0.26)}}},
        {"9", {w, {oval(0.28, 0.69, 0.28, 0.31), nine_stem}}},
    };
}

Glyphs signs() {
    const Stroke two = joined(arc(0.15, 0.86, 0.14, 0.14, 170, -38), {{0.01, 0.5}, {0.3, 0.5}});
    return {
        {".", {0.02, {{{0, 0}, {0.02, 0}}}}},
        {"-", {0.4, {{{0, 0.42}, {0.4, 0.42}}}}},
        {"+", {0.44, {{{0, 0.42}, {0.44, 0.42}}, {{0.22, 0.2}, {0.22, 0.64}}}}},
        {"/", {0.36, {{{0, -0.12}, {0.36, 1.06}}}}},
        {"²", {0.3, {two}}},
    };
}

Glyphs letters() {
    constexpr double w = 0.46, h = 0.7, r = 0.23;  // width and height of x, and radius of bowls
    const Stroke stem{{0, h}, {0, 0}}, right_stem{{w, h}, {w, 0}};
    const Stroke bowl = oval(r, h / 2, r, h / 2);
    const Stroke arch = joined(arc(r, h - r, r, r, 180, 0), {{w, 0}});
    const Stroke narrow = joined(arc(0.2, h - 0.2, 0.2, 0.2, 180, 0), {{0.4, 0}});
    const Stroke second = joined(arc(0.6, h - 0.2, 0.2, 0.2, 180, 0), {{0.8, 0}});
    return {
        {"a", {w, {bowl, right_stem}}},
        {"c", {w - 0.03, {arc(r, h / 2, r, h / 2, 50, 310)}}},
        {"d", {w, {bowl, {{w, 1.04}, {w, 0}}}}},
        {"e", {w, {joined({{0.02, h / 2}, {w, h / 2}}, arc(r, h / 2, r, h / 2, 0, 310))}}},
        {"f", {0.28, {joined(arc(0.3, 0.84, 0.2, 0.2, 75, 180), {{0.1, 0}}), {{0, h}, {0.28, h}}}}},
        {"i", {0.0, {stem, {{0, 1}, {0.001, 1}}}}},
        {"l", {0.0, {{{0, 1.04}, {0, 0}}}}},
        {"m", {0.8, {stem, narrow, second}}},
        {"n", {w, {stem, arch}}},
        {"o", {w, {bowl}}},
        {"r", {0.28, {stem, arc(0.26, h - 0.26, 0.26, 0.26, 180, 75)}}},
        {"t",
         {0.3, {joined({{0.1, 0.95}}, arc(0.3, 0.2, 0.2, 0.2, 180, 285)), {{0, h}, {0.3, h}}}}},
        {"u", {w, {joined({{0, h}}, arc(r, r, r, r, 180, 360)), right_stem}}},
        {"x", {w, {{{0, 0}, {w, h}}, {{0, h}, {w, 0}}}}},
        {"W", {0.96, {{{0, 1}, {0.22, 0}, {0.48, 0.86}, {0.74, 0}, {0.96, 1}}}}},
    };
}

Glyphs all_glyphs() {
    Glyphs all = digits();
    all.merge(signs());
    all.merge(letters());
    return all;
}

}  // namespace

const Glyph& glyph_of(std::string_view character) {
    static const Glyphs glyphs = all_glyphs();
    static const Glyph gap{0.3, {}};
    const auto found = glyphs.find(character);
    return found == glyphs.end() ? gap : found->second;
}

}  // namespace patchlight::raster
