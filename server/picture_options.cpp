#include "server/picture_options.h"

#include "server/cameras_json.h"
#include "server/false_colour.h"
#include "server/wording.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace patchlight::server {
namespace {

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

void resize(const std::string& size, const Scene& scene, NamedCamera& camera) {
    const std::size_t cross = std::min(size.find('x'), size.size());
    const std::string_view width_and_rest = size;
    const int width = pixels(size, width_and_rest.substr(0, cross));
    const int height = pixels(size, width_and_rest.substr(std::min(cross + 1, size.size())));
    if (camera.is_made) camera = framing_camera(scene, width, height);
    camera.camera.width = width;
    camera.camera.height = height;
}

}  // namespace

void PictureOptions::add_to(CLI::App& command, CLI::Option& image, CLI::Option& scene) {
    command.add_option("--camera", camera_, "which camera; the first if not given")
        ->type_name("NAME")
        ->needs(&image);
    command.add_option("--size", size_, "of the picture in pixels; the camera's if not given")
        ->type_name("WxH")
        ->needs(&image);
    command
        .add_option("--exposure", exposure_,
                    "of a .png or .glb, in stops; from the light if not given")
        ->type_name("EV")
        ->check(exposure_in_range());
    const auto take = [this, &scene](const std::vector<std::string>& words) {
        take_false_colour(words, scene);
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--false-colour", take,
            "show irradiance (illuminance): .png in colours with a scale, the others as numbers")
        ->type_name("[MIN:MAX]")
        ->expected(0, 1)
        ->allow_extra_args(false)
        ->needs(&image);
}

/// Its value is optional, so the word that follows may be the scene.
void PictureOptions::take_false_colour(const std::vector<std::string>& words, CLI::Option& scene) {
    false_colour_.emplace();
    if (words.empty() || words.front().empty()) return;
    const std::string& word = words.front();
    false_colour_->range = read_shown_range(word);
    if (false_colour_->range) return;
    if (scene.count() > 0)
        throw WrongInput("--false-colour: must be MIN:MAX, such as 0:500, not " + in_quotes(word));
    scene.add_result(word);
    scene.run_callback();
}

void PictureOptions::check(const std::vector<ImageFormat>& formats, bool is_mesh_wanted) const {
    if (exposure_ && false_colour_ && !is_mesh_wanted)
        throw WrongInput("--exposure: means nothing with --false-colour");
    const bool any_png =
        std::find(formats.begin(), formats.end(), ImageFormat::png) != formats.end();
    if (exposure_ && !any_png && !is_mesh_wanted)
        throw WrongInput(
            "--exposure: only .png pictures and .glb meshes are exposed, and none is asked for");
}

std::vector<PictureRequest> PictureOptions::requests(const std::vector<ImageFormat>& formats,
                                                     const std::string& file, Job& job) const {
    if (formats.empty()) return {};
    return {{chosen_camera(file, job), formats, exposure_, false_colour_}};
}

/// The camera of the job that is asked for, with the size that is asked for.
NamedCamera& PictureOptions::chosen_camera(const std::string& file, Job& job) const {
    const auto has_name = [&](const NamedCamera& camera) { return camera.name == *camera_; };
    auto chosen = job.cameras.begin();
    if (camera_) chosen = std::find_if(job.cameras.begin(), job.cameras.end(), has_name);
    if (chosen == job.cameras.end()) {
        std::vector<std::string> known;
        for (const NamedCamera& camera : job.cameras) known.push_back(camera.name);
        throw WrongInput("--camera: there is no camera " + in_quotes(*camera_) + " in " + file +
                         suggestion(*camera_, known));
    }
    if (size_) resize(*size_, job.scene, *chosen);
    return *chosen;
}

}  // namespace patchlight::server
