#include "server/chart/chart_view.h"

#include "server/picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patchlight::server {
namespace {

constexpr double bands = 4.0;  // a decade: steps of colour read more surely, and pack better

raster::ShownRange mapped_range() {
    return {std::log10(mapped_error_least), std::log10(mapped_error_most)};
}

/// The logarithm in the middle of its band.
float banded(double logarithm) {
    return static_cast<float>((std::floor(bands * logarithm) + 0.5) / bands);
}

/// Y(B − E) at each vertex of the display [W/m²].
std::vector<double> reflected_at_vertices(const Scene& scene, const Solution& solution) {
    const DisplayMesh& display = solution.display;
    std::vector<double> reflected(display.positions.size(), 0.0);
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const Surface& surface = scene.surfaces[solution.mesh.patches[display.patch[t]].surface];
        const Rgb& exitance = scene.materials[surface.material].exitance;
        for (const std::uint32_t v : display.triangles[t])
            reflected[v] = luminance(display.radiosity[v] - exitance);
    }
    return reflected;
}

}  // namespace

raster::Camera small_camera(raster::Camera camera, int most_pixels) {
    const double scale =
        std::min(1.0, static_cast<double>(most_pixels) / std::max(camera.width, camera.height));
    camera.width = std::max(1, static_cast<int>(std::lround(scale * camera.width)));
    camera.height = std::max(1, static_cast<int>(std::lround(scale * camera.height)));
    return camera;
}

ChartView take_view(const Scene& scene, const Solution& solution, const raster::Camera& camera) {
    const DisplayMesh& display = solution.display;
    return {take_picture(solution, camera),
            raster::render_quantity(camera, display.positions,
                                    reflected_at_vertices(scene, solution), display.triangles)};
}

raster::Image error_map(const raster::QuantityImage& a, const raster::QuantityImage& b,
                        double level) {
    raster::QuantityImage map = a;
    for (std::size_t k = 0; k < map.quantity.size(); ++k) {
        const double error = std::abs(static_cast<double>(a.quantity[k]) - b.quantity[k]) / level;
        map.quantity[k] = banded(std::log10(std::max(error, 0.1 * mapped_error_least)));
    }
    return raster::false_colour_image(map, mapped_range());
}

raster::Image error_scale(int width, int height) {
    const raster::ShownRange range = mapped_range();
    raster::QuantityImage ramp{width, height, {}, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double share = (x + 0.5) / width;
            ramp.quantity.push_back(banded(range.least + share * (range.most - range.least)));
            ramp.coverage.push_back(1.0F);
        }
    return raster::false_colour_image(ramp, range);
}

}  // namespace patchlight::server
