#include "server/run_job.h"

#include "server/peak_memory.h"

#include "server/exposure.h"
#include "server/false_colour.h"
#include "server/result_json.h"
#include "server/viewpoints.h"
#include "solver/solve_scene.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace patchlight::server {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ImageReport report_of(const PictureRequest& request, ImageFormat format,
                      const raster::Image& image) {
    return {request.camera.name, content_type(format), image.width, image.height, {}};
}

std::vector<MadeImage> take_light_pictures(const Job& job, const Solution& solution,
                                           const PictureRequest& request) {
    const raster::Image image = take_picture(solution, request.camera.camera);
    const double exposure =
        request.exposure ? *request.exposure : automatic_exposure(job.scene, solution);
    std::vector<MadeImage> made;
    for (const ImageFormat format : request.formats) {
        ImageReport report = report_of(request, format, image);
        if (format == ImageFormat::png) report.exposure = exposure;
        made.push_back({std::move(report), encode(image, format, exposure)});
    }
    return made;
}

std::vector<MadeImage> take_false_colour_pictures(const Job& job, const Solution& solution,
                                                  const PictureRequest& request) {
    const raster::QuantityImage seen =
        take_irradiance_picture(job.scene, solution, request.camera.camera);
    const raster::ShownRange range =
        request.false_colour->range.value_or(automatic_range(job.scene, solution));
    constexpr double as_it_is = 0.0;  // stops
    std::vector<MadeImage> made;
    for (const ImageFormat format : request.formats) {
        const raster::Image image = false_colour_picture(seen, format, range, job.units.light);
        ImageReport report = report_of(request, format, image);
        report.false_colour = {range.least, range.most, format == ImageFormat::png};
        made.push_back({std::move(report), encode(image, format, as_it_is)});
    }
    return made;
}

std::vector<MadeImage> take_pictures(const Job& job, const Solution& solution,
                                     const std::vector<PictureRequest>& requests) {
    std::vector<MadeImage> made;
    for (const PictureRequest& request : requests)
        for (MadeImage& image : request.false_colour
                                    ? take_false_colour_pictures(job, solution, request)
                                    : take_light_pictures(job, solution, request))
            made.push_back(std::move(image));
    return made;
}

}  // namespace

JobResult run_job(const Job& job, const std::vector<PictureRequest>& requests, double load_seconds,
                  const Observer& observe) {
    const Clock::time_point start = Clock::now();
    JobResult result;
    result.solution = solve_scene(job.scene, job.settings, observe, viewpoints(job));
    const Clock::time_point solved = Clock::now();
    result.images = take_pictures(job, result.solution, requests);
    for (const MadeImage& image : result.images) result.run.images.push_back(image.report);
    result.run.load_seconds = load_seconds;
    result.run.render_seconds = seconds_since(solved);
    result.run.total_seconds = load_seconds + seconds_since(start);
    using Control = tbb::global_control;
    result.run.threads = static_cast<int>(Control::active_value(Control::max_allowed_parallelism));
    result.run.peak_memory = peak_memory();
    result.document = result_json(job, result.solution, result.run);
    return result;
}

}  // namespace patchlight::server
