#include "server/solve_command.h"

#include "raster/image_module.h"
#include "server/interrupt.h"
#include "server/output_files.h"
#include "server/progress_line.h"
#include "server/scene_file.h"
#include "server/summary.h"
#include "server/thread_limit.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>

namespace patchlight::server {
namespace {

/// Said even if the results are written to files, as a script may not look at the exit code.
void tell_why_unfinished(const Solution& solution) {
    if (solution.status == Status::limit) {
        std::cerr << "patchlight: a limit was reached first: ";
        if (!solution.error.target)
            std::cerr << "the result is not converged\n";
        else if (solution.error.estimate)
            std::cerr << "the accuracy is about " << rounded(*solution.error.estimate) << ", not "
                      << rounded(*solution.error.target) << "\n";
        else
            std::cerr << "how accurate the result is has not been measured\n";
    }
    if (solution.status == Status::cancelled)
        std::cerr << "patchlight: interrupted: the result is what there was so far\n";
}

int exit_code(Status status) {
    constexpr int done = 0;
    constexpr int limit_reached = 3;
    constexpr int interrupted = 130;  // what a shell says of a program that SIGINT ended
    switch (status) {
        case Status::converged:
            return done;
        case Status::limit:
            return limit_reached;
        case Status::cancelled:
            return interrupted;
    }
    throw std::logic_error("a status without an exit code");
}

}  // namespace

CLI::App* SolveCommand::add_to(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("solve", "Solve a scene; write pictures and results");
    CLI::Option* scene =
        command
            ->add_option("SCENE", scene_,
                         "scene JSON, or .obj, .gltf, .glb, .stl; - for standard input")
            ->required();
    CLI::Option* image = command->add_option("--image", outputs_.images,
                                             "picture to write: .png, .exr or .pfm; may repeat");
    image->type_name("FILE")->take_all()->expected(1)->allow_extra_args(false);
    pictures_.add_to(*command, *image, *scene);
    const auto add_output = [&](const char* option, auto& path, const char* meaning) {
        command->add_option(option, path, meaning)->type_name("FILE");
    };
    add_output("--stats", outputs_.stats, "result JSON to write; - for standard output");
    add_output("--sensors", outputs_.sensors, "irradiance at sensors, as .csv; - likewise");
    add_output("--patches", outputs_.patches, "light on every patch, as .csv; - likewise");
    add_output("--mesh", outputs_.mesh, "the surfaces with their light, as .glb");
    trace_.add_to(*command);
    command->add_flag("--quiet", is_quiet_, "no progress on the terminal");
    settings_.add_to(*command);
    return command;
}

int SolveCommand::run() const {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<ImageFormat> formats = checked_formats(outputs_);
    require_not_read(outputs_.paths(), {scene_});
    pictures_.check(formats, outputs_.mesh.has_value());
    trace_.prepare();
    if (trace_.is_asked() || std::any_of(formats.begin(), formats.end(), needs_codec))
        raster::preload_image_codec();
    catch_interrupts();
    Job job = read_job();
    const auto requests = pictures_.requests(formats, shown_path(scene_), job);
    const std::chrono::duration<double> load = std::chrono::steady_clock::now() - start;
    const NamedCamera traced = TraceOptions::camera(job, requests);
    StepPictures steps(traced.camera);
    const JobResult result = solve(job, requests, load.count(), [&](const Progress& progress) {
        if (trace_.is_asked()) steps.watch(progress);
    });
    write_outputs(outputs_, pictures_.exposure(), job, result);
    trace_.write(job, result, shown_path(scene_), traced, pictures_.exposure(), steps);
    if (outputs_.none() && !trace_.is_asked()) std::cout << summary(job, result);
    tell_why_unfinished(result.solution);
    return exit_code(result.solution.status);
}

Job SolveCommand::read_job() const {
    Job job = read_scene_file(scene_);
    require_not_read(outputs_.paths(), job.files);
    settings_.lay_over(job);
    require_in_scene(outputs_, job.scene, shown_path(scene_));
    return job;
}

JobResult SolveCommand::solve(const Job& job, const std::vector<PictureRequest>& requests,
                              double load_seconds,
                              const std::function<void(const Progress&)>& watch) const {
    const ThreadLimit limit(job.settings.threads);
    JobResult result;
    settings_.naming_culprit(shown_path(scene_), [&] {
        ProgressLine line(!is_quiet_);
        const Observer observe = [&](const Progress& progress) {
            line.show(progress);
            watch(progress);
            return is_interrupted() ? Verdict::stop : Verdict::go_on;
        };
        result = run_job(job, requests, load_seconds, observe);
    });
    return result;
}

}  // namespace patchlight::server
