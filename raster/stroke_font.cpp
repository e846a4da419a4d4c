#include "raster/stroke_font.h"

#include "raster/stroke_glyphs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace patchlight::raster {
namespace {

using Eigen::Vector2d;

constexpr double pen = 0.14;  // width of a stroke [digit heights]
constexpr double gap = 0.17;  // between glyphs [digit heights]

constexpr double least_radius = 0.6;  // of the pen, so that small text is not faint [pixels]

struct Segment {
    Vector2d begin, end;  // [pixels]
};

std::size_t character_length(char first) {
    const auto byte = static_cast<unsigned char>(first);
    return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Calls use(glyph, left) for each; returns where the last one ends [digit heights].
template <class Use>
double set_type(std::string_view text, const Use& use) {
    double left = 0.0;
    while (!text.empty()) {
        const std::size_t length = std::min(character_length(text.front()), text.size());
        const Glyph& glyph = glyph_of(text.substr(0, length));
        use(glyph, left);
        left += glyph.width + pen + gap;
        text.remove_prefix(length);
    }
    return std::max(0.0, left - gap);
}

double distance(const Vector2d& point, const Segment& segment) {
    const Vector2d along = segment.end - segment.begin;
    const double length = along.squaredNorm();
    const double part =
        length > 0.0 ? std::clamp((point - segment.begin).dot(along) / length, 0.0, 1.0) : 0.0;
    return (point - segment.begin - part * along).norm();
}

/// How much of a pixel's square a stroke takes, about.
double share_inked(const Vector2d& pixel, const std::vector<Segment>& segments, double radius) {
    double nearest = radius + 1.0;
    for (const Segment& segment : segments) nearest = std::min(nearest, distance(pixel, segment));
    return std::clamp(radius + 0.5 - nearest, 0.0, 1.0);
}

std::vector<Segment> segments_of(std::string_view text, double left, double baseline,
                                 double height) {
    // Strokes lie within the digit's height with their whole width.
    const double scale = height * (1.0 - pen);
    const double half_pen = 0.5 * pen * height;
    std::vector<Segment> segments;
    set_type(text, [&](const Glyph& glyph, double begin) {
        const auto placed = [&](const Vector2d& p) {
            return Vector2d(left + height * begin + half_pen + height * p.x(),
                            baseline - half_pen - scale * p.y());
        };
        for (const Stroke& stroke : glyph.strokes)
            for (std::size_t k = 1; k < stroke.size(); ++k)
                segments.push_back({placed(stroke[k - 1]), placed(stroke[k])});
    });
    return segments;
}

}  // namespace

double text_width(std::string_view text, const TextStyle& style) {
    return style.height * set_type(text, [](const Glyph&, double) {});
}

void draw_text(Image& image, std::string_view text, double left, double baseline,
               const TextStyle& style) {
    const double height = style.height;
    const std::vector<Segment> segments = segments_of(text, left, baseline, height);
    const auto within = [](double place, int size) {
        return std::clamp(static_cast<int>(std::floor(place)), 0, size);
    };
    const double radius = std::max(least_radius, 0.5 * pen * height);
    const int first_x = within(left - 1, image.width);
    const int last_x = within(left + text_width(text, style) + 2, image.width);
    const int first_y = within(baseline - 1.2 * height, image.height);
    const int last_y = within(baseline + 0.3 * height, image.height);
    for (int y = first_y; y < last_y; ++y)
        for (int x = first_x; x < last_x; ++x) {
            const double inked = share_inked(Vector2d(x + 0.5, y + 0.5), segments, radius);
            const std::size_t pixel =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x));
            for (std::size_t c = 0; c < 3; ++c) {
                float& channel = image.rgb[pixel + c];
                channel = static_cast<float>((1.0 - inked) * static_cast<double>(channel) +
                                             inked * style.ink[static_cast<Eigen::Index>(c)]);
            }
        }
}

}  // namespace patchlight::raster
