#include "server/trace/trace_options.h"

#include "server/exposure.h"
#include "server/output_files.h"
#include "server/trace/trace_files.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace patchlight::server {

void TraceOptions::add_to(CLI::App& command) {
    CLI::Option* trace =
        command
            .add_option("--trace", directory_,
                        "show how it is solved: pictures of steps, convergence, a row of form "
                        "factors and a hemicube, with a page, index.html")
            ->type_name("DIR");
    command
        .add_option("--trace-patch", patch_,
                    "whose row and hemicube, as --patches counts; a lamp's if not given")
        ->type_name("K")
        ->needs(trace);
}

void TraceOptions::prepare() const {
    if (!directory_) return;
    std::error_code failure;
    std::filesystem::create_directories(*directory_, failure);
    std::error_code unknown;
    if (!std::filesystem::is_directory(*directory_, unknown))
        throw WrongInput("--trace " + *directory_ + ": the directory cannot be made" +
                         (failure ? ": " + failure.message() : ""));
    require_writable("--trace", *directory_ + "/index.html");
}

NamedCamera TraceOptions::camera(const Job& job, const std::vector<PictureRequest>& requests) {
    NamedCamera chosen = requests.empty() ? job.cameras.front() : requests.front().camera;
    constexpr int longest = 512;  // all pictures of a trace are kept until the end [pixels]
    raster::Camera& camera = chosen.camera;
    const double scale = static_cast<double>(longest) / std::max(camera.width, camera.height);
    if (scale >= 1.0) return chosen;
    camera.width = std::max(1, static_cast<int>(scale * camera.width));
    camera.height = std::max(1, static_cast<int>(scale * camera.height));
    return chosen;
}

void TraceOptions::write(const Job& job, const JobResult& result, const std::string& scene,
                         const NamedCamera& camera, std::optional<double> exposure,
                         const StepPictures& steps) const {
    if (!directory_) return;
    const Solution& solution = result.solution;
    const std::size_t patches = solution.mesh.size();
    if (patch_ && *patch_ >= patches)
        throw WrongInput("--trace-patch: there are " + std::to_string(patches) +
                         " patches, numbered from 0");
    Trace trace{job,
                result,
                scene,
                camera,
                exposure.value_or(automatic_exposure(job.scene, solution)),
                steps.taken(),
                {}};
    if (solution.status != Status::cancelled) trace.sight = trace_sight(job, solution, patch_);
    write_trace(*directory_, trace);
}

}  // namespace patchlight::server
