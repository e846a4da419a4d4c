#include "raster/item_buffer.h"

#include "raster/scan_convert.h"

#include <cassert>
#include <stdexcept>

namespace patchlight::raster {
namespace {

const SamplePattern& pixel_centre() {
    static const SamplePattern pattern = sample_pattern(1);
    return pattern;
}

/// Writes an item wherever it is the nearest.
struct ItemSink {
    float* nearness;
    std::uint32_t* items;
    int width;
    ScreenPlane plane;
    float farthest;
    float nearest;
    std::uint32_t item;

    [[gnu::always_inline]] void filled(int row, Span columns) const {
        const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
        float* const row_nearness = nearness + start;
        std::uint32_t* const row_items = items + start;
        const double at_row = plane.at(0.5, row + 0.5);
        for (int x = columns.first; x < columns.last; ++x) {
            const float exact = static_cast<float>(at_row + plane.dx * x);
            const float raised = exact > farthest ? exact : farthest;
            const float here = raised < nearest ? raised : nearest;
            const bool seen = here >= row_nearness[x] * (1.0F - nearness_tie);
            row_nearness[x] = seen ? here : row_nearness[x];
            row_items[x] = seen ? item : row_items[x];
        }
    }
    /// With one sample a pixel there are no pixels that are covered in part.
    [[gnu::always_inline]] void partly(int, int, const TriangleEdges&) const {}
};

PATCHLIGHT_FOR_EACH_ISA
void draw_item(const ScreenCorners& corners, const SamplePattern& pattern, int height,
               ItemSink sink) {
    scan_convert(corners, pattern, sink.width, {0, height}, sink);
}

}  // namespace

ItemBuffer::ItemBuffer(int width, int height) : viewport_{width, height} {
    if (width < 1 || height < 1 || width > most_pixels || height > most_pixels)
        throw std::invalid_argument("item buffer: an edge must have 1 to 16384 pixels");
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    nearness_.assign(pixels, 0.0F);
    items_.assign(pixels, nothing);
}

void ItemBuffer::clear() {
    std::fill(nearness_.begin(), nearness_.end(), 0.0F);
    std::fill(items_.begin(), items_.end(), nothing);
}

void ItemBuffer::draw_on_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                                std::uint32_t item) {
    const std::int64_t area = turn(a.snapped, b.snapped, c.snapped);
    if (area == 0) return;
    const ScreenCorners corners = area > 0 ? ScreenCorners{a.snapped, b.snapped, c.snapped}
                                           : ScreenCorners{a.snapped, c.snapped, b.snapped};
    const auto [farthest, nearest] = std::minmax({a.nearness, b.nearness, c.nearness});
    const ScreenPlane plane = PlaneFit(a, b, c).through(a.nearness, b.nearness, c.nearness);
    draw_item(corners, pixel_centre(), viewport_.height,
              {nearness_.data(), items_.data(), viewport_.width, plane,
               static_cast<float>(farthest), static_cast<float>(nearest), item});
}

void ItemBuffer::draw(std::span<const Eigen::Vector4d> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles,
                      std::span<const std::uint32_t> items) {
    assert(items.size() == triangles.size());
    vertices_.clear();
    for (const Eigen::Vector4d& position : positions)
        vertices_.push_back(project(position, viewport_));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const ProjectedVertex& a = vertices_[triangles[t][0]];
        const ProjectedVertex& b = vertices_[triangles[t][1]];
        const ProjectedVertex& c = vertices_[triangles[t][2]];
        if (a.planes_outside & b.planes_outside & c.planes_outside) continue;
        if ((a.planes_outside | b.planes_outside | c.planes_outside) == 0) {
            draw_on_screen(a.screen, b.screen, c.screen, items[t]);
            continue;
        }
        clip_to_screen({.position = a.position}, {.position = b.position}, {.position = c.position},
                       viewport_, [&](const auto& p, const auto& q, const auto& r) {
                           draw_on_screen(p.vertex, q.vertex, r.vertex, items[t]);
                       });
    }
}

}  // namespace patchlight::raster
