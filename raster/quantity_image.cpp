#include "raster/quantity_image.h"

#include "raster/colour_map.h"
#include "raster/render.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace patchlight::raster {
namespace {

/// Neighbours that are wholly covered, of 8.
int covered_neighbours(const QuantityImage& seen, int column, int row) {
    int count = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, seen.height - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, seen.width - 1); ++x) {
            const bool is_itself = x == column && y == row;
            const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) +
                               static_cast<std::size_t>(x);
            if (!is_itself && seen.coverage[pixel] >= 1.0F) ++count;
        }
    return count;
}

/// Where differently cut surfaces meet, a sample now and then slips through between them: dust on
/// dark colours. An outline has fewer covered neighbours than a pinhole.
void close_pinholes(QuantityImage& seen) {
    constexpr float mostly = 0.75F;
    constexpr int around = 6;
    std::vector<std::size_t> pinholes;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width) +
                               static_cast<std::size_t>(x);
            const float coverage = seen.coverage[pixel];
            if (coverage >= mostly && coverage < 1.0F && covered_neighbours(seen, x, y) >= around)
                pinholes.push_back(pixel);
        }
    for (const std::size_t pixel : pinholes) seen.coverage[pixel] = 1.0F;
}

}  // namespace

QuantityImage render_quantity(const Camera& camera, std::span<const Eigen::Vector3d> positions,
                              std::span<const double> quantity,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
    assert(quantity.size() == positions.size());
    std::vector<Eigen::Array3d> colours;
    colours.reserve(quantity.size());
    for (const double each : quantity) colours.emplace_back(each, 1.0, 0.0);
    const Image image = render(camera, {positions, colours, triangles});
    QuantityImage seen{image.width, image.height, {}, {}};
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        const float sum = image.rgb[i];
        const float coverage = image.rgb[i + 1];
        seen.quantity.push_back(coverage > 0.0F ? sum / coverage : 0.0F);
        seen.coverage.push_back(coverage);
    }
    close_pinholes(seen);
    return seen;
}

Image grey_image(const QuantityImage& seen) {
    Image image{seen.width, seen.height, {}};
    image.rgb.reserve(3 * seen.quantity.size());
    for (const float quantity : seen.quantity) image.rgb.insert(image.rgb.end(), 3, quantity);
    return image;
}

Image false_colour_image(const QuantityImage& seen, const ShownRange& range) {
    Image image{seen.width, seen.height, {}};
    image.rgb.reserve(3 * seen.quantity.size());
    for (std::size_t i = 0; i < seen.quantity.size(); ++i) {
        const double share =
            (static_cast<double>(seen.quantity[i]) - range.least) / (range.most - range.least);
        const double coverage = static_cast<double>(seen.coverage[i]);
        const Eigen::Array3d colour =
            coverage * mapped_colour(share) + (1.0 - coverage) * background_grey;
        for (const double channel : colour) image.rgb.push_back(static_cast<float>(channel));
    }
    return image;
}

}  // namespace patchlight::raster
