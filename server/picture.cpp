#include "server/picture.h"

#include "raster/image_file.h"
#include "raster/render.h"
#include "server/output_files.h"

#include <numbers>
#include <stdexcept>
#include <vector>

namespace patchlight::server {
std::optional<ImageFormat> format_of_file(std::string_view path) {
    if (has_ending(path, ".png")) return ImageFormat::png;
    if (has_ending(path, ".exr")) return ImageFormat::exr;
    if (has_ending(path, ".pfm")) return ImageFormat::pfm;
    return std::nullopt;
}

std::string content_type(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return "image/png";
        case ImageFormat::exr:
            return "image/x-exr";
        case ImageFormat::pfm:
            return "image/x-portable-floatmap";
    }
    throw std::logic_error("a format without a content type");
}

bool needs_codec(ImageFormat format) { return format != ImageFormat::pfm; }

namespace {
/// 36 samples a pixel: a hundredth of the contrast across a silhouette is left as error.
constexpr int samples_per_axis = 6;
}  // namespace

raster::Image take_picture(const Solution& solution, const raster::Camera& camera) {
    std::vector<Rgb> radiance;
    radiance.reserve(solution.display.radiosity.size());
    for (const Rgb& radiosity : solution.display.radiosity)
        radiance.push_back(radiosity / std::numbers::pi);
    return raster::render(camera,
                          {solution.display.positions, radiance, solution.display.triangles},
                          {samples_per_axis});
}

std::string encode(const raster::Image& image, ImageFormat format, double exposure) {
    switch (format) {
        case ImageFormat::png:
            return raster::encode_png(image, exposure);
        case ImageFormat::exr:
            return raster::encode_exr(image);
        case ImageFormat::pfm:
            return raster::encode_pfm(image);
    }
    throw std::logic_error("a format that is not encoded");
}

}  // namespace patchlight::server
