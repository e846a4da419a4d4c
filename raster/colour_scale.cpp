#include "raster/colour_scale.h"

#include "raster/colour_map.h"
#include "raster/scale_ticks.h"
#include "raster/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace patchlight::raster {
namespace {

constexpr double ink = 0.012;  // of numbers and lines, linear

/// Where everything is, in whole pixels, so that edges are sharp.
struct Layout {
    TextStyle text;
    int line = 1;  // width of lines
    int bar_left = 0;
    int bar_width = 0;
    int bar_top = 0;
    int bar_bottom = 0;  // first row below the bar
    int label_left = 0;
    int title_left = 0;
    int total_width = 0;
    std::vector<Tick> ticks;

    int bar_height() const { return bar_bottom - bar_top; }
    int line_height() const { return text.height * 9 / 5; }
};

double widest(const std::vector<Tick>& ticks, const std::vector<std::string>& title,
              const Layout& layout) {
    double right = 0.0;
    for (const Tick& tick : ticks)
        right = std::max(right, layout.label_left + text_width(tick.label, layout.text));
    for (const std::string& line : title)
        right = std::max(right, layout.title_left + text_width(line, layout.text));
    return right;
}

Layout lay_out(const Image& picture, const ColourScale& scale) {
    Layout layout;
    const int unit = std::max(7, picture.height / 46);
    layout.text = {unit, Eigen::Array3d::Constant(ink)};
    layout.line = std::max(1, unit / 10);
    layout.title_left = layout.bar_left = picture.width + unit * 3 / 2;
    layout.bar_width = unit * 8 / 5;
    layout.label_left = layout.bar_left + layout.bar_width + unit;
    const int title = static_cast<int>(scale.title.size()) * layout.line_height();
    layout.bar_top = std::min(unit * 3 / 2 + title + unit / 2, picture.height);
    layout.bar_bottom = std::max(layout.bar_top, picture.height - unit * 3 / 2);
    const int most_ticks = layout.bar_height() / (unit * 5 / 2) + 1;
    if (layout.bar_height() >= unit)
        layout.ticks =
            scale_ticks(scale.range.least, scale.range.most, std::clamp(most_ticks, 2, 7));
    layout.total_width =
        static_cast<int>(std::ceil(widest(layout.ticks, scale.title, layout))) + unit * 3 / 2;
    return layout;
}

void fill(Image& image, int left, int top, int width, int height, const Eigen::Array3d& colour) {
    for (int y = std::max(top, 0); y < std::min(top + height, image.height); ++y)
        for (int x = std::max(left, 0); x < std::min(left + width, image.width); ++x)
            for (int c = 0; c < 3; ++c)
                image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x)) +
                          static_cast<std::size_t>(c)] = static_cast<float>(colour[c]);
}

Image widened(const Image& picture, int width) {
    Image image{width, picture.height, {}};
    const auto old_row = 3 * static_cast<std::size_t>(picture.width);
    const auto new_row = 3 * static_cast<std::size_t>(width);
    image.rgb.assign(new_row * static_cast<std::size_t>(picture.height),
                     static_cast<float>(background_grey));
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y)
        std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(y * old_row), old_row,
                    image.rgb.begin() + static_cast<std::ptrdiff_t>(y * new_row));
    return image;
}

void draw_bar(Image& image, const Layout& at) {
    const Eigen::Array3d frame = Eigen::Array3d::Constant(ink);
    fill(image, at.bar_left - at.line, at.bar_top - at.line, at.bar_width + 2 * at.line,
         at.bar_height() + 2 * at.line, frame);
    for (int y = 0; y < at.bar_height(); ++y)
        fill(image, at.bar_left, at.bar_bottom - 1 - y, at.bar_width, 1,
             mapped_colour((y + 0.5) / at.bar_height()));
}

void draw_ticks(Image& image, const Layout& at, const ShownRange& range) {
    for (const Tick& tick : at.ticks) {
        const double share = (tick.place - range.least) / (range.most - range.least);
        const double row = at.bar_bottom - share * at.bar_height();
        const int top = std::clamp(static_cast<int>(std::lround(row - 0.5 * at.line)),
                                   at.bar_top - at.line, at.bar_bottom);
        fill(image, at.bar_left + at.bar_width, top, at.line + at.text.height / 2, at.line,
             Eigen::Array3d::Constant(ink));
        const double baseline = top + (at.line + at.text.height) / 2;
        draw_text(image, tick.label, at.label_left, baseline, at.text);
    }
}

}  // namespace

Image with_colour_scale(const Image& picture, const ColourScale& scale) {
    const Layout layout = lay_out(picture, scale);
    Image image = widened(picture, layout.total_width);
    if (layout.bar_height() < 1) return image;
    int baseline = layout.text.height * 3 / 2 + layout.text.height;
    for (const std::string& line : scale.title) {
        draw_text(image, line, layout.title_left, baseline, layout.text);
        baseline += layout.line_height();
    }
    draw_bar(image, layout);
    draw_ticks(image, layout, scale.range);
    return image;
}

}  // namespace patchlight::raster
