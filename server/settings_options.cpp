#include "server/settings_options.h"

#include "server/input_errors.h"
#include "server/json_value.h"
#include "server/solve_json.h"
#include "server/wording.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>

namespace patchlight::server {
namespace {

/// "--patch-size" is "patch_size" in a scene.
std::string key_of(std::string option) {
    option.erase(0, 2);
    std::replace(option.begin(), option.end(), '-', '_');
    return option;
}

std::string option_of(std::string key) {
    std::replace(key.begin(), key.end(), '_', '-');
    return "--" + key;
}

/// A number as a shell user writes it, ".5" included; whole ones exactly.
nlohmann::json number_of(const std::string& option, const std::string& text) {
    const char* const end = text.data() + text.size();
    std::uint64_t whole = 0;
    if (const auto read = std::from_chars(text.data(), end, whole);
        read.ec == std::errc() && read.ptr == end)
        return whole;
    double number = 0.0;
    const auto read = std::from_chars(text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end)
        throw WrongInput(option + ": must be a number, not " + in_quotes(text));
    return number;
}

void refuse_accuracy(const std::string&) {
    throw WrongInput("--accuracy: belongs to `solve`; give --patch-size and --rays");
}

}  // namespace

void SettingsOptions::add(CLI::App& command, const std::string& option, const std::string& meaning,
                          bool is_number, bool is_shown) {
    const auto keep = [this, option, is_number](const std::string& text) {
        block_[key_of(option)] = is_number ? number_of(option, text) : nlohmann::json(text);
    };
    command.add_option_function<std::string>(option, keep, meaning)
        ->type_name(is_number ? "N" : "NAME")
        ->group(is_shown ? "Settings (they override the scene's)" : "");
}

void SettingsOptions::add_to(CLI::App& command, bool solved) {
    constexpr bool text = false;
    constexpr bool number = true;
    if (solved)
        add(command, "--accuracy", "relative error wanted; 0.02 unless something is set by hand",
            number);
    else
        command.add_option_function<std::string>("--accuracy", &refuse_accuracy)->group("");
    add(command, "--solver", "auto, gauss-seidel or shooting", text, solved);
    add(command, "--form-factors", "auto, hemicube, ray-cast or analytic", text);
    add(command, "--patch-size", "longest edge of a patch, in the scene's unit of length", number);
    add(command, "--rays", "rays per patch", number);
    add(command, "--hemicube-resolution", "pixels along the top face of a hemicube", number);
    add(command, "--tolerance", "bound on the solver's error at which it stops", number, solved);
    add(command, "--max-iterations", "sweeps, or shots, at most", number, solved);
    add(command, "--seed", "of the random numbers", number);
    add(command, "--time-limit", "in seconds", number);
    add(command, "--memory-limit", "in bytes", number);
    command.add_option("--threads", threads_, "how many to use; all cores if not given")
        ->type_name("N")
        ->check(CLI::Range(1, 1024))
        ->group("Settings (they override the scene's)");
}

void SettingsOptions::lay_over(Job& job) const {
    job.settings.threads = threads_;
    try {
        read_solve(JsonValue(block_), job.units.metres, job.settings);
    } catch (const InputError& error) {
        std::string lines;
        for (const InputFault& fault : faults_of(error)) {
            const std::string pointer = "/solve" + fault.pointer;
            lines += (lines.empty() ? "" : "\n") + culprit(pointer).value_or(pointer) + ": " +
                     fault.detail;
        }
        throw WrongInput(lines);
    }
}

void SettingsOptions::naming_culprit(const std::string& file,
                                     const std::function<void()>& work) const {
    naming_file(file, [&] {
        try {
            work();
        } catch (const InputError& error) {
            if (const auto option = culprit(error.pointer()))
                throw WrongInput(*option + ": " + error.what());
            throw;
        }
    });
}

/// The option that gave what `pointer` points to.
std::optional<std::string> SettingsOptions::culprit(const std::string& pointer) const {
    constexpr std::string_view block = "/solve/";
    if (!pointer.starts_with(block)) return std::nullopt;
    const std::string key = pointer.substr(block.size());
    if (!block_.contains(key)) return std::nullopt;
    return option_of(key);
}

}  // namespace patchlight::server
