#include "server/solve_outputs.h"

#include "raster/write_whole.h"
#include "server/exposure.h"
#include "server/mesh_glb.h"
#include "server/output_files.h"
#include "server/output_stream.h"
#include "server/patches_csv.h"
#include "server/result_text.h"
#include "server/sensors_csv.h"
#include "server/wrong_input.h"

#include <exception>
#include <functional>

namespace patchlight::server {
namespace {

/// Text that any name will do for, but for CSV under the name of something else.
void check_text(const char* option, const std::optional<std::string>& path,
                std::initializer_list<std::string_view> endings) {
    if (!path || *path == to_standard_output) return;
    require_ending(option, *path, endings);
    require_writable(option, *path);
}

/// Goes on where one has failed, and throws the first failure in the end.
class Attempts {
  public:
    void attempt(const std::function<void()>& write) {
        try {
            write();
        } catch (...) {
            if (!failure_) failure_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    std::exception_ptr failure_;
};

}  // namespace

std::vector<std::string> SolveOutputs::paths() const {
    std::vector<std::string> all = images;
    for (const auto* path : {&stats, &sensors, &patches, &mesh})
        if (*path) all.push_back(**path);
    return all;
}

std::vector<ImageFormat> checked_formats(const SolveOutputs& outputs) {
    std::vector<ImageFormat> formats;
    for (const std::string& path : outputs.images) {
        const auto format = format_of_file(path);
        if (!format)
            throw WrongInput("--image " + path + ": the name must end in .png, .exr or .pfm");
        require_writable("--image", path);
        formats.push_back(*format);
    }
    check_text("--stats", outputs.stats, {});
    check_text("--sensors", outputs.sensors, {".csv"});
    check_text("--patches", outputs.patches, {".csv"});
    if (outputs.mesh) {
        require_ending("--mesh", *outputs.mesh, {".glb"});
        require_writable("--mesh", *outputs.mesh);
    }
    require_different(outputs.paths());
    return formats;
}

void require_in_scene(const SolveOutputs& outputs, const Scene& scene, const std::string& file) {
    if (outputs.sensors && scene.sensors.empty())
        throw WrongInput("--sensors: there are no `sensors` in " + file);
}

void write_outputs(const SolveOutputs& outputs, std::optional<double> exposure, const Job& job,
                   const JobResult& result) {
    Attempts all;
    const Solution& solution = result.solution;
    const auto write = [&](const std::optional<std::string>& path, const auto& writer) {
        if (path) all.attempt([&] { write_output(*path, writer); });
    };
    write(outputs.stats, [&](const TextSink& sink) { sink(result_text(result.document)); });
    write(outputs.sensors,
          [&](const TextSink& sink) { write_sensors_csv(job.scene, solution, sink); });
    write(outputs.patches,
          [&](const TextSink& sink) { write_patches_csv(job.scene, solution, sink); });
    write(outputs.mesh, [&](const TextSink& sink) {
        sink(mesh_glb(job, solution, exposure.value_or(automatic_exposure(job.scene, solution))));
    });
    for (std::size_t k = 0; k < outputs.images.size(); ++k)
        all.attempt([&] { raster::write_whole(outputs.images[k], result.images.at(k).bytes); });
    all.rethrow();
}

}  // namespace patchlight::server
