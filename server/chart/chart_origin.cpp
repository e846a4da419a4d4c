#include "server/chart/chart_origin.h"

#include "server/scene_file.h"
#include "server/utf8_text.h"
#include "server/version.h"
#include "server/wording.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <thread>

namespace patchlight::server {
namespace {

std::string processor_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view key = "model name";
        const std::size_t colon = line.find(':');
        if (!line.starts_with(key) || colon == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
        return begin == std::string::npos ? "" : as_utf8(line.substr(begin));
    }
    return "";
}

}  // namespace

std::string shell_word(const std::string& word) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-./,:+=@%").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

ChartOrigin describe_origin(const std::string& scene, const std::string& directory,
                            double time_limit) {
    return {as_utf8(shown_path(scene)),
            as_utf8("patchlight chart " + shell_word(scene) + " --output " + shell_word(directory) +
                    " --time-limit " + number_text(time_limit)),
            processor_model(), std::max(1, static_cast<int>(std::thread::hardware_concurrency())),
            program_version()};
}

}  // namespace patchlight::server
