#pragma once

#include "raster/quantity_image.h"
#include "server/job.h"
#include "server/picture.h"
#include "server/run_report.h"
#include "solver/solution.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// Colours that stand for irradiance.
struct FalseColourRequest {
    std::optional<raster::ShownRange> range;  // empty: from the solution [W/m² or lx]
};

/// One view, in as many formats as are wanted of it.
struct PictureRequest {
    NamedCamera camera;
    std::vector<ImageFormat> formats;
    std::optional<double> exposure;  // of PNG; empty: from the solution [stops]
    std::optional<FalseColourRequest> false_colour = {};  // empty: the light as it is
};

struct MadeImage {
    ImageReport report;
    std::string bytes;  // of the file
};

struct JobResult {
    Solution solution;
    std::vector<MadeImage> images;  // request by request, format by format
    RunReport run;
    nlohmann::ordered_json document;  // the result JSON
};

/// Solves a job and takes its pictures. `load_seconds` is what reading it took. Throws what
/// solve_scene throws, and std::runtime_error if a picture cannot be encoded.
JobResult run_job(const Job& job, const std::vector<PictureRequest>& requests, double load_seconds,
                  const Observer& observe);

}  // namespace patchlight::server
