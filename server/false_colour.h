#pragma once

#include "raster/image.h"
#include "raster/quantity_image.h"
#include "server/job.h"
#include "server/picture.h"
#include "solver/solution.h"

#include <optional>
#include <string_view>

namespace patchlight::server {

/// The least and most that colours tell apart, from "MIN:MAX", in the scene's unit of light.
/// Nothing if it is not that: two numbers, 0 <= MIN < MAX.
std::optional<raster::ShownRange> read_shown_range(std::string_view text);

/// From 0 to a round number that 99.5 % of the surfaces shown, by area, do not exceed in scalar
/// irradiance. Taken from the solution and not from a view, so that all views of it match.
raster::ShownRange automatic_range(const Scene& scene, const Solution& solution);

/// The scalar irradiance (illuminance) of the surface seen at each pixel [W/m² or lx].
raster::QuantityImage take_irradiance_picture(const Scene& scene, const Solution& solution,
                                              const raster::Camera& camera);

/// What goes into a file: for PNG the colours with their scale beside them, for exposure 0; for EXR
/// and PFM, which are there to be measured in, the irradiance itself.
raster::Image false_colour_picture(const raster::QuantityImage& seen, ImageFormat format,
                                   const raster::ShownRange& range, LightUnit light);

}  // namespace patchlight::server
