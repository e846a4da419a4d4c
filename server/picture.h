#pragma once

#include "raster/camera.h"
#include "raster/image.h"
#include "solver/solution.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

enum class ImageFormat : std::uint8_t { png, exr, pfm };

/// By the end of a file name, in small letters or capitals.
std::optional<ImageFormat> format_of_file(std::string_view path);

std::string content_type(ImageFormat format);

/// PNG and EXR need the image module (see raster/image_module.h); PFM needs nothing.
bool needs_codec(ImageFormat format);

/// What the camera sees of a solution: L = B / π, linear.
raster::Image take_picture(const Solution& solution, const raster::Camera& camera);

/// The bytes of a file. `exposure` is for PNG alone [stops].
std::string encode(const raster::Image& image, ImageFormat format, double exposure);

}  // namespace patchlight::server
