#include "server/trace/trace_files.h"

#include "raster/image_file.h"
#include "raster/write_whole.h"
#include "server/output_stream.h"
#include "server/trace/convergence_chart.h"
#include "server/trace/hemicube_pictures.h"
#include "server/trace/row_picture.h"
#include "server/trace/trace_page.h"

#include <array>
#include <cstdio>
#include <functional>

namespace patchlight::server {
namespace {

constexpr double as_it_is = 0.0;  // exposure of what is in display colours already [stops]

class Directory {
  public:
    explicit Directory(const std::string& path) : path_(path) {}

    void picture(const std::string& name, const raster::Image& image, double exposure) const {
        raster::write_whole(path_ + "/" + name, raster::encode_png(image, exposure));
    }
    void text(const std::string& name, const std::function<void(const TextSink&)>& write) const {
        write_output(path_ + "/" + name, write);
    }

  private:
    std::string path_;
};

void write_sight(const Directory& directory, const Trace& trace, const PatchSight& sight) {
    const PatchMesh& mesh = trace.result.solution.mesh;
    directory.picture("row.png", row_picture(mesh, sight, trace.camera.camera), as_it_is);
    directory.text("row.csv", [&](const TextSink& sink) {
        write_row_csv(trace.job.scene, mesh, sight, sink);
    });
    const PatchColours colours(trace.job.scene, mesh);
    const auto faces = face_pictures(sight.faces, colours);
    for (std::size_t face = 0; face < faces.size(); ++face)
        directory.picture(face_file(face), faces[face], as_it_is);
    directory.picture("hemicube.png", unfolded_patches(sight.faces, colours), as_it_is);
    directory.picture("hemicube-delta.png", unfolded_delta_factors(sight.faces), as_it_is);
}

}  // namespace

PatchSight trace_sight(const Job& job, const Solution& solution, std::optional<PatchIndex> patch) {
    constexpr int fine = 128;
    return look_from_patch(job.scene, solution.mesh, solution.settings,
                           patch.value_or(brightest_emitter(job.scene, solution.mesh)),
                           solution.settings.hemicube_resolution.value_or(fine));
}

void write_trace(const std::string& path, const Trace& trace) {
    const Directory directory(path);
    const Solution& solution = trace.result.solution;
    for (const StepPicture& step : trace.steps) {
        directory.picture(step_file(step, false), step.picture, trace.exposure);
        if (step.without_ambient)
            directory.picture(step_file(step, true), *step.without_ambient, trace.exposure);
    }
    directory.picture("last.png", take_picture(solution, trace.camera.camera), trace.exposure);
    directory.text("convergence.csv", [&](const TextSink& sink) {
        write_convergence_csv(solution.convergence, sink);
    });
    const bool shoots = solution.settings.method == Method::shooting;
    directory.text("convergence.svg", [&](const TextSink& sink) {
        sink(convergence_svg(solution.convergence, shoots ? "shots" : "sweeps"));
    });
    if (trace.sight) write_sight(directory, trace, *trace.sight);
    directory.text("index.html", [&](const TextSink& sink) { sink(trace_page(trace)); });
}

std::string step_file(const StepPicture& step, bool without_ambient) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "step-%07d", step.step);
    return std::string(name.data()) + (without_ambient ? "-without-ambient.png" : ".png");
}

std::string face_file(std::size_t face) {
    constexpr const char* names[] = {"top", "plus-x", "minus-x", "plus-y", "minus-y"};
    return std::string("hemicube-") + names[face] + ".png";
}

}  // namespace patchlight::server
