#include "server/solve_command.h"

#include "raster/image_module.h"
#include "raster/write_whole.h"
#include "server/cameras_json.h"
#include "server/interrupt.h"
#include "server/not_built.h"
#include "server/output_files.h"
#include "server/progress_line.h"
#include "server/result_text.h"
#include "server/scene_file.h"
#include "server/summary.h"
#include "server/thread_limit.h"
#include "server/wording.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iostream>

namespace patchlight::server {
namespace {

constexpr const char* to_standard_output = "-";

int pixels(const std::string& size, std::string_view digits) {
    int count = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, count);
    if (read.ec != std::errc() || read.ptr != end || count < 1 || count > most_pixels_along_an_edge)
        throw WrongInput("--size: must be WIDTHxHEIGHT, each from 1 to " +
                         std::to_string(most_pixels_along_an_edge) + ", not " + in_quotes(size));
    return count;
}

/// Written so that NaN is refused, which CLI::Range lets through.
CLI::Validator exposure_in_range() {
    const auto check = [](const std::string& text) {
        double exposure = 0.0;
        constexpr double most = 100.0;
        const bool is_right =
            CLI::detail::lexical_cast(text, exposure) && std::abs(exposure) <= most;
        return is_right ? std::string() : "must be from -100 to 100, not " + in_quotes(text);
    };
    return CLI::Validator(check, "", "");
}

/// Said even if the results are written to files, as a script may not look at the exit code.
void tell_why_unfinished(Status status) {
    if (status == Status::limit)
        std::cerr << "patchlight: a limit was reached first: the result is not converged\n";
    if (status == Status::cancelled)
        std::cerr << "patchlight: interrupted: the result is what there was so far\n";
}

void resize(const std::string& size, const Scene& scene, NamedCamera& camera) {
    const std::size_t cross = std::min(size.find('x'), size.size());
    const std::string_view width_and_rest = size;
    const int width = pixels(size, width_and_rest.substr(0, cross));
    const int height = pixels(size, width_and_rest.substr(std::min(cross + 1, size.size())));
    if (camera.is_made) camera = framing_camera(scene, width, height);
    camera.camera.width = width;
    camera.camera.height = height;
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

void refuse_options_not_built(CLI::App& command) {
    for (const char* option : {"--false-colour", "--sensors", "--patches", "--mesh"})
        command
            .add_option_function<std::vector<std::string>>(
                option,
                [option](const std::vector<std::string>&) {
                    throw WrongInput(why_not_built(option));
                })
            ->expected(0, 1)
            ->group("");
}

}  // namespace

CLI::App* SolveCommand::add_to(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("solve", "Solve a scene; write pictures and results");
    command->add_option("SCENE", scene_, "scene JSON; - for standard input")->required();
    CLI::Option* image =
        command->add_option("--image", images_, "picture to write: .png, .exr or .pfm; may repeat")
            ->type_name("FILE")
            ->take_all()
            ->expected(1)
            ->allow_extra_args(false);
    command->add_option("--camera", camera_, "which camera; the first if not given")
        ->type_name("NAME")
        ->needs(image);
    command->add_option("--size", size_, "of the picture in pixels; the camera's if not given")
        ->type_name("WxH")
        ->needs(image);
    command->add_option("--exposure", exposure_, "of a .png, in stops; from the light if not given")
        ->type_name("EV")
        ->needs(image)
        ->check(exposure_in_range());
    command->add_option("--stats", stats_, "result JSON to write; - for standard output")
        ->type_name("FILE");
    command->add_flag("--quiet", is_quiet_, "no progress on the terminal");
    settings_.add_to(*command);
    refuse_options_not_built(*command);
    return command;
}

int SolveCommand::run() const {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<ImageFormat> formats = checked_formats();
    if (std::any_of(formats.begin(), formats.end(), needs_codec)) raster::preload_image_codec();
    catch_interrupts();
    Job job = read_job();
    std::vector<PictureRequest> requests;
    if (!formats.empty()) requests.push_back({chosen_camera(job), formats, exposure_});
    const std::chrono::duration<double> load = std::chrono::steady_clock::now() - start;
    const ThreadLimit limit(job.settings.threads);
    JobResult result;
    settings_.naming_culprit(shown_path(scene_), [&] {
        ProgressLine line(!is_quiet_);
        const Observer observe = [&](const Progress& progress) {
            line.show(progress);
            return is_interrupted() ? Verdict::stop : Verdict::go_on;
        };
        result = run_job(job, requests, load.count(), observe);
    });
    write(job, result);
    return exit_code(result.solution.status);
}

/// The formats of the pictures asked for, once all outputs are known to be possible.
std::vector<ImageFormat> SolveCommand::checked_formats() const {
    std::vector<ImageFormat> formats;
    std::vector<std::string> paths = images_;
    for (const std::string& path : images_) {
        const auto format = format_of_file(path);
        if (!format)
            throw WrongInput("--image " + path + ": the name must end in .png, .exr or .pfm");
        require_writable("--image", path);
        formats.push_back(*format);
    }
    if (stats_ && stats_ != to_standard_output) {
        require_writable("--stats", *stats_);
        paths.push_back(*stats_);
    }
    require_different(paths);
    if (exposure_ && std::find(formats.begin(), formats.end(), ImageFormat::png) == formats.end())
        throw WrongInput("--exposure: only .png pictures are exposed, and none is asked for");
    return formats;
}

Job SolveCommand::read_job() const {
    Job job = read_scene_file(scene_);
    settings_.lay_over(job);
    return job;
}

/// The camera of the job that is asked for, with the size that is asked for.
NamedCamera& SolveCommand::chosen_camera(Job& job) const {
    const auto has_name = [&](const NamedCamera& camera) { return camera.name == *camera_; };
    auto chosen = job.cameras.begin();
    if (camera_) chosen = std::find_if(job.cameras.begin(), job.cameras.end(), has_name);
    if (chosen == job.cameras.end()) {
        std::vector<std::string> known;
        for (const NamedCamera& camera : job.cameras) known.push_back(camera.name);
        throw WrongInput("--camera: there is no camera " + in_quotes(*camera_) + " in " +
                         shown_path(scene_) + suggestion(*camera_, known));
    }
    if (size_) resize(*size_, job.scene, *chosen);
    return *chosen;
}

void SolveCommand::write(const Job& job, const JobResult& result) const {
    for (std::size_t k = 0; k < images_.size(); ++k)
        raster::write_whole(images_[k], result.images.at(k).bytes);
    if (stats_ == to_standard_output)
        std::cout << result_text(result.document);
    else if (stats_)
        raster::write_whole(*stats_, result_text(result.document));
    else if (images_.empty())
        std::cout << summary(job, result);
    tell_why_unfinished(result.solution.status);
}

}  // namespace patchlight::server
