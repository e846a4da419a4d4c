#include "server/false_colour.h"

#include "raster/colour_scale.h"
#include "raster/scale_ticks.h"
#include "solver/display/vertex_irradiance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace patchlight::server {
namespace {

std::optional<double> read_number(std::string_view text) {
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number)) return std::nullopt;
    return number;
}

std::vector<double> scalar_irradiance(const Scene& scene, const Solution& solution) {
    std::vector<double> scalars;
    for (const Rgb& irradiance : vertex_irradiance(scene, solution))
        scalars.push_back(luminance(irradiance));
    return scalars;
}

/// Mean irradiance and area of a triangle.
struct Lit {
    double irradiance = 0.0;  // [W/m²]
    double area = 0.0;        // [m²]
};

std::vector<Lit> lit_triangles(const Scene& scene, const Solution& solution) {
    const DisplayMesh& display = solution.display;
    const std::vector<double> scalars = scalar_irradiance(scene, solution);
    std::vector<Lit> triangles;
    for (const auto& [a, b, c] : display.triangles) {
        const Vec3& corner = display.positions[a];
        const Vec3 normal = (display.positions[b] - corner).cross(display.positions[c] - corner);
        triangles.push_back({(scalars[a] + scalars[b] + scalars[c]) / 3.0, 0.5 * normal.norm()});
    }
    return triangles;
}

/// The irradiance that `share` of the area does not exceed.
double percentile(std::vector<Lit> triangles, double share) {
    std::sort(triangles.begin(), triangles.end(),
              [](const Lit& a, const Lit& b) { return a.irradiance < b.irradiance; });
    double area = 0.0;
    for (const Lit& triangle : triangles) area += triangle.area;
    double below = 0.0;
    for (const Lit& triangle : triangles) {
        below += triangle.area;
        if (below >= share * area) return triangle.irradiance;
    }
    return 0.0;
}

}  // namespace

std::optional<raster::ShownRange> read_shown_range(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto least = read_number(text.substr(0, colon));
    const auto most = read_number(text.substr(colon + 1));
    if (!least || !most || *least < 0.0 || *most <= *least) return std::nullopt;
    return raster::ShownRange{*least, *most};
}

raster::ShownRange automatic_range(const Scene& scene, const Solution& solution) {
    constexpr double share = 0.995;  // the rest may be a small spot close to a lamp
    const double most = percentile(lit_triangles(scene, solution), share);
    return {0.0, most > 0.0 ? raster::round_number_above(most) : 1.0};
}

raster::QuantityImage take_irradiance_picture(const Scene& scene, const Solution& solution,
                                              const raster::Camera& camera) {
    return raster::render_quantity(camera, solution.display.positions,
                                   scalar_irradiance(scene, solution), solution.display.triangles);
}

raster::Image false_colour_picture(const raster::QuantityImage& seen, ImageFormat format,
                                   const raster::ShownRange& range, LightUnit light) {
    if (format != ImageFormat::png) return raster::grey_image(seen);
    const bool photometric = light == LightUnit::photometric;
    const raster::ColourScale scale{
        range, {photometric ? "illuminance" : "irradiance", photometric ? "lx" : "W/m²"}};
    return raster::with_colour_scale(raster::false_colour_image(seen, range), scale);
}

}  // namespace patchlight::server
