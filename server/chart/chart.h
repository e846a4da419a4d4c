#pragma once

#include "raster/image.h"
#include "raster/quantity_image.h"
#include "server/chart/chart_method.h"

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// What the scene's first camera sees of a solution.
struct ChartView {
    raster::Image picture;            // linear radiance
    raster::QuantityImage reflected;  // Y(B − E) of what is seen [W/m²]
};

/// A method that was measured.
struct ChartPoint {
    ChartMethod method;
    double seconds = 0.0;  // of solving, median of the repeats; errors it measures for its own
                           // report not counted
    int repeats = 0;
    std::size_t patches = 0;
    std::optional<double> estimate;  // what the solve says of its error itself [1]
    std::optional<double> error;     // true error of the displayed field [1]
    bool is_at_floor = false;        // too near the reference's own error to be told
    bool is_on_front = false;
    ChartView view;
};

/// A method that was not.
struct SkippedMethod {
    ChartMethod method;
    std::string why;
};

/// What errors are measured against.
struct ChartReference {
    bool is_known = false;           // the exact answer, else a solve to a far tighter accuracy
    double accuracy = 0.0;           // that solve was asked for [1]
    std::optional<double> estimate;  // of its own error: the chart's floor [1]
    double seconds = 0.0;
    bool is_at_sensors = false;  // nothing reflects: errors are of the irradiance at sensors
    double level = 0.0;  // √(∫ Y(B − E)² dA / ∫ dA), what errors in pictures refer to [W/m²]
    double exposure = 0.0;  // of pictures [stops]
    ChartView view;
};

struct Chart {
    std::optional<ChartReference> reference;  // absent: time was up before
    std::vector<ChartPoint> points;           // quickest first
    std::vector<SkippedMethod> skipped;
    double time_limit = 0.0;  // [s]
    double seconds = 0.0;     // that all of it took
    int threads = 1;
    bool is_interrupted = false;
};

/// Sorts the points, and marks those on the front and at the floor.
void mark_points(Chart& chart);

}  // namespace patchlight::server
