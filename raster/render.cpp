#include "raster/render.h"

#include "raster/sample_band.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <cassert>
#include <stdexcept>

namespace patchlight::raster {
namespace {

constexpr std::size_t band_bytes = std::size_t{1} << 19;  // samples in hand per thread, about
constexpr std::size_t triangles_per_chunk = 256;

using Projected = std::vector<ProjectedVertex>;
using Triangles = std::vector<ShadedTriangle>;

Projected project_all(const Camera& camera, std::span<const Eigen::Vector3d> positions) {
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& position : positions) bounds.extend(position);
    const Eigen::Matrix4d canonical = canonical_from_world(camera, bounds);
    const Viewport viewport = {camera.width, camera.height};
    Projected vertices(positions.size());
    tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
        vertices[i] = project(canonical * positions[i].homogeneous(), viewport);
    });
    return vertices;
}

/// Adds the visible part of one triangle.
void add_visible(const Projected& vertices, const TriangleView& view, std::size_t t,
                 const Viewport& viewport, Triangles& visible) {
    const auto [i, j, k] = view.triangles[t];
    const ProjectedVertex& a = vertices[i];
    const ProjectedVertex& b = vertices[j];
    const ProjectedVertex& c = vertices[k];
    if (a.planes_outside & b.planes_outside & c.planes_outside) return;
    if (!faces_eye(a.position, b.position, c.position)) return;
    const auto add = [&](const ScreenCorner& p, const ScreenCorner& q, const ScreenCorner& r) {
        if (const auto triangle = shaded_triangle(p, q, r)) visible.push_back(*triangle);
    };
    if ((a.planes_outside | b.planes_outside | c.planes_outside) == 0) {
        add({a.screen, view.colours[i]}, {b.screen, view.colours[j]}, {c.screen, view.colours[k]});
        return;
    }
    clip_to_screen({a.position, view.colours[i]}, {b.position, view.colours[j]},
                   {c.position, view.colours[k]}, viewport, add);
}

/// What is seen of the triangles, in their order.
Triangles visible_triangles(const Camera& camera, const TriangleView& view) {
    const Projected vertices = project_all(camera, view.positions);
    const Viewport viewport = {camera.width, camera.height};
    const std::size_t count = view.triangles.size();
    std::vector<Triangles> chunks((count + triangles_per_chunk - 1) / triangles_per_chunk);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
        const std::size_t last = std::min(count, (chunk + 1) * triangles_per_chunk);
        for (std::size_t t = chunk * triangles_per_chunk; t < last; ++t)
            add_visible(vertices, view, t, viewport, chunks[chunk]);
    });
    Triangles visible;
    for (const Triangles& chunk : chunks) visible.insert(visible.end(), chunk.begin(), chunk.end());
    return visible;
}

/// For each band the triangles that may touch it, in their order.
std::vector<std::vector<std::uint32_t>> bands_of(const Triangles& triangles, int band_rows,
                                                 int height) {
    const int last_band = (height - 1) / band_rows;
    std::vector<std::vector<std::uint32_t>> bands(static_cast<std::size_t>(last_band) + 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const ScreenCorners& corners = triangles[t].corners;
        const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
        const int last = std::min(last_band, bottom / subpixels / band_rows);
        for (int band = top / subpixels / band_rows; band <= last; ++band)
            bands[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(t));
    }
    return bands;
}

int rows_per_band(const Camera& camera, const SamplePattern& pattern) {
    const std::size_t row_bytes = static_cast<std::size_t>(camera.width) *
                                  static_cast<std::size_t>(pattern.lanes) * 4 * sizeof(float);
    return static_cast<int>(std::max<std::size_t>(1, band_bytes / row_bytes));
}

}  // namespace

Image render(const Camera& camera, const TriangleView& view, const RenderSettings& settings) {
    assert(view.colours.size() == view.positions.size());
    if (camera.width > most_pixels || camera.height > most_pixels)
        throw std::invalid_argument("picture: an edge must have 1 to 16384 pixels");
    const SamplePattern pattern = sample_pattern(settings.samples_per_axis);
    const Triangles triangles = visible_triangles(camera, view);
    const int band_rows = rows_per_band(camera, pattern);
    const auto bands = bands_of(triangles, band_rows, camera.height);
    Image image{camera.width, camera.height, {}};
    const std::size_t row_size = 3 * static_cast<std::size_t>(camera.width);
    image.rgb.resize(row_size * static_cast<std::size_t>(camera.height));
    tbb::enumerable_thread_specific<SampleBand> samples;
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
        const int first = static_cast<int>(band) * band_rows;
        const Span rows = {first, std::min(first + band_rows, camera.height)};
        SampleBand& local = samples.local();
        local.reset(pattern, camera.width, rows);
        local.draw(triangles, bands[band]);
        const auto row_count = static_cast<std::size_t>(rows.last - rows.first);
        local.average(std::span(image.rgb).subspan(static_cast<std::size_t>(first) * row_size,
                                                   row_count * row_size));
    });
    return image;
}

}  // namespace patchlight::raster
