#pragma once

#include "raster/camera.h"
#include "server/chart/chart.h"
#include "solver/solution.h"

namespace patchlight::server {

/// The camera, with a picture no larger than so many pixels along either edge.
raster::Camera small_camera(raster::Camera camera, int most_pixels);

ChartView take_view(const Scene& scene, const Solution& solution, const raster::Camera& camera);

/// |a − b| at each pixel relative to `level`, in colours: `mapped_error_least` and less in the
/// first, `mapped_error_most` and more in the last, in four steps a decade. For exposure 0.
raster::Image error_map(const raster::QuantityImage& a, const raster::QuantityImage& b,
                        double level);
inline constexpr double mapped_error_least = 1e-3, mapped_error_most = 1.0;  // [1]

/// Its colours from left to right. For exposure 0.
raster::Image error_scale(int width, int height);

}  // namespace patchlight::server
