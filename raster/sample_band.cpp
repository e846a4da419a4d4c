#include "raster/sample_band.h"

#include "raster/lanes.h"

#include <cassert>

namespace patchlight::raster {
namespace {

[[gnu::always_inline]] inline FloatLanes load(const float* values) {
    FloatLanes lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

[[gnu::always_inline]] inline void store(float* values, const FloatLanes& lanes) {
    std::memcpy(values, &lanes, sizeof lanes);
}

/// Draws one triangle into the samples of a band.
struct ShadeSink {
    const ShadedTriangle& triangle;
    const SamplePattern& pattern;
    float* samples;
    int width;
    int first_row;

    [[gnu::always_inline]] float* group(int row, int x, int lane) const {
        const auto pixel =
            static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x);
        return samples + 4 * (pixel * static_cast<std::size_t>(pattern.lanes) +
                              static_cast<std::size_t>(lane));
    }

    [[gnu::always_inline]] FloatLanes at_samples(const ScreenPlane& plane, int row, int x,
                                                 int lane) const {
        return static_cast<float>(plane.at(x, row)) +
               static_cast<float>(plane.dx) *
                   load(&pattern.x_pixels[static_cast<std::size_t>(lane)]) +
               static_cast<float>(plane.dy) *
                   load(&pattern.y_pixels[static_cast<std::size_t>(lane)]);
    }

    /// Samples of `mask` that the triangle is seen at take its colour and nearness.
    [[gnu::always_inline]] void shade(int row, int x, int lane, IntLanes mask) const {
        float* const stored = group(row, x, lane);
        const FloatLanes nearness =
            clamp(at_samples(triangle.nearness, row, x, lane), triangle.farthest, triangle.nearest);
        const FloatLanes before = load(stored);
        mask &= nearness >= before * (1.0F - nearness_tie);
        if (!any(mask)) return;
        store(stored, mask ? nearness : before);
        const FloatLanes w = 1.0F / at_samples(triangle.inverse_w, row, x, lane);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            float* const value = stored + (channel + 1) * lane_group;
            const FloatLanes colour =
                clamp(w * at_samples(triangle.colour_over_w[channel], row, x, lane),
                      triangle.darkest[channel], triangle.brightest[channel]);
            store(value, mask ? colour : load(value));
        }
    }

    [[gnu::always_inline]] void filled(int row, Span columns) const {
        for (int x = columns.first; x < columns.last; ++x)
            for (int lane = 0; lane < pattern.lanes; lane += lane_group)
                shade(row, x, lane, IntLanes{} == IntLanes{});
    }

    [[gnu::always_inline]] void partly(int row, int x, const TriangleEdges& edges) const {
        for (int lane = 0; lane < pattern.lanes; lane += lane_group) {
            const IntLanes mask = edges.covered(x, lane);
            if (any(mask)) shade(row, x, lane, mask);
        }
    }
};

PATCHLIGHT_FOR_EACH_ISA
void draw_triangles(std::span<const ShadedTriangle> triangles, std::span<const std::uint32_t> order,
                    const SamplePattern& pattern, float* samples, int width, Span rows) {
    for (const std::uint32_t t : order) {
        ShadeSink sink{triangles[t], pattern, samples, width, rows.first};
        scan_convert(triangles[t].corners, pattern, width, rows, sink);
    }
}

/// Mean of one channel over the samples of a pixel, always added in the same order; in double, so
/// that the mean of equal samples is what they are.
float mean(const float* pixel, std::size_t channel, const SamplePattern& pattern) {
    std::array<double, lane_group> total{};
    for (int lane = 0; lane < pattern.lanes; lane += lane_group) {
        const float* const values = pixel + 4 * lane + (channel + 1) * lane_group;
        const int counted = std::min(lane_group, pattern.count - lane);
        for (int k = 0; k < counted; ++k) total[static_cast<std::size_t>(k)] += values[k];
    }
    const double sum = ((total[0] + total[4]) + (total[2] + total[6])) +
                       ((total[1] + total[5]) + (total[3] + total[7]));
    return static_cast<float>(sum / pattern.count);
}

}  // namespace

void SampleBand::reset(const SamplePattern& pattern, int width, Span rows) {
    pattern_ = pattern;
    width_ = width;
    rows_ = rows;
    samples_.assign(static_cast<std::size_t>(rows.last - rows.first) *
                        static_cast<std::size_t>(width) * static_cast<std::size_t>(pattern.lanes) *
                        4,
                    0.0F);
}

void SampleBand::draw(std::span<const ShadedTriangle> triangles,
                      std::span<const std::uint32_t> order) {
    draw_triangles(triangles, order, pattern_, samples_.data(), width_, rows_);
}

void SampleBand::average(std::span<float> rgb) const {
    const auto values_per_pixel = static_cast<std::size_t>(pattern_.lanes) * 4;
    assert(rgb.size() * values_per_pixel == samples_.size() * 3);
    for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel)
        for (std::size_t channel = 0; channel < 3; ++channel)
            rgb[3 * pixel + channel] = mean(&samples_[pixel * values_per_pixel], channel, pattern_);
}

}  // namespace patchlight::raster
