#include "tests/walls/walls.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <regex>
#include <sstream>

namespace patchlight::walls {
namespace {

/// Beginnings of include paths: "Eigen/" is all of Eigen.
using Paths = std::vector<std::string_view>;

Paths operator+(Paths some, const Paths& more) {
    some.insert(some.end(), more.begin(), more.end());
    return some;
}

/// What a room, or a file in it, may include. For a file, the longest `place` it begins with
/// counts.
struct Door {
    std::string_view place;
    Paths may_include;
};

const Paths numbers = {"Eigen/", "tbb/", "oneapi/tbb/"};
const Paths system_calls = {"unistd.h", "fcntl.h", "dlfcn.h", "sys/"};
const Paths network = {"arpa/", "netdb.h", "netinet/", "poll.h", "pthread.h", "signal.h"};

const Paths scene = Paths{"solver/scene/"} + numbers;
const Paths mesh = scene + Paths{"solver/mesh/"};
const Paths rays = mesh + Paths{"solver/rays/"};
const Paths plain_types = {"solver/settings.h", "solver/solution.h"};
const Paths form_factors = rays + plain_types + Paths{"solver/form_factors/"};
const Paths transport = form_factors + Paths{"solver/transport/"};
const Paths hierarchy = form_factors + Paths{"solver/hierarchy/", "solver/transport/stop_rule.h"};
const Paths findings = rays + Paths{"solver/settings.h", "solver/findings/", "unsupported/Eigen/"};
const Paths below_accuracy = transport + Paths{"solver/hierarchy/"};

const Paths ways_in =
    Paths{"server/", "solver/", "raster/", "nlohmann/", "openssl/"} + numbers + system_calls;

const std::vector<Door> doors = {
    {"raster/", Paths{"raster/"} + numbers + system_calls},
    {"raster/image_codec.cpp", {"raster/", "OpenImageIO/"}},
    {"solver/scene/", scene},
    {"solver/mesh/", mesh},
    {"solver/rays/", rays},
    {"solver/rays/embree_scene.h", rays + Paths{"embree3/", "embree4/"}},
    {"solver/findings/", findings},
    {"solver/form_factors/", form_factors},
    {"solver/form_factors/hemicube",
     form_factors + Paths{"raster/item_buffer.h", "raster/camera.h"}},
    {"solver/transport/", transport},
    {"solver/hierarchy/", hierarchy},
    {"solver/accuracy/", below_accuracy + Paths{"solver/accuracy/", "solver/display/"}},
    {"solver/display/", below_accuracy + Paths{"solver/display/"}},
    {"solver/settings.h", {}},
    {"solver/solution.h", mesh + Paths{"solver/settings.h"}},
    {"solver/", Paths{"solver/"} + numbers + system_calls},
    {"server/files/", Paths{"server/files/", "server/json_", "server/transform_json.h",
                            "server/unique_names.h", "server/utf8_text.h", "server/wording.h",
                            "solver/scene/", "raster/mean_colour.h", "nlohmann/"} +
                          numbers},
    {"server/", ways_in + Paths{"CLI/", "signal.h"}},
    {"server/chart/run_gnuplot", ways_in + Paths{"signal.h", "spawn.h"}},
    {"server/http/", ways_in + network + Paths{"spdlog/"}},
    {"server/http/hardened_server.cpp", {"server/http/", "httplib.h"}},
};

/// Neither raster/ nor solver/ logs or prints.
const std::array<std::string_view, 3> printing = {"iostream", "print", "syncstream"};

bool begins_with_one_of(std::string_view path, const Paths& beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](std::string_view beginning) { return path.starts_with(beginning); });
}

const Door* door_of(std::string_view file) {
    const Door* nearest = nullptr;
    for (const Door& door : doors)
        if (file.starts_with(door.place) && (!nearest || door.place.size() > nearest->place.size()))
            nearest = &door;
    return nearest;
}

/// A header of the C++ language, such as <vector> or <cmath>: they alone have neither folder nor
/// ending. Headers of the processor's vector instructions count with them.
bool is_standard(const Include& include) {
    return !include.quoted &&
           (include.path.find_first_of("/.") == std::string::npos ||
            include.path.ends_with("mmintrin.h") || include.path == "immintrin.h");
}

bool is_allowed(std::string_view file, const Door& door, const Include& include) {
    if (is_standard(include))
        return file.starts_with("server/") ||
               std::find(printing.begin(), printing.end(), include.path) == printing.end();
    if (include.path.find("..") != std::string::npos) return false;
    return begins_with_one_of(include.path, door.may_include);
}

}  // namespace

std::vector<Include> includes_in(std::string_view source) {
    static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]*)[>"].*)");
    std::vector<Include> found;
    std::istringstream lines{std::string(source)};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::smatch match;
        if (std::regex_match(line, match, pattern))
            found.push_back({number, match[1] == "\"", match[2]});
    }
    return found;
}

std::vector<std::string> crossings(std::string_view file, std::string_view source) {
    const Door* const door = door_of(file);
    if (!door) return {std::string(file) + " is in no room that walls.cpp knows"};
    std::vector<std::string> found;
    for (const Include& include : includes_in(source))
        if (!is_allowed(file, *door, include))
            found.push_back(std::string(file) + ":" + std::to_string(include.line) + " includes " +
                            include.path + ", which " + std::string(door->place) + " may not");
    return found;
}

std::vector<std::string> sources_below(const std::filesystem::path& root) {
    std::vector<std::string> sources;
    for (const char* const room : {"raster", "solver", "server"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / room))
            if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
                sources.push_back(entry.path().lexically_relative(root).generic_string());
    std::sort(sources.begin(), sources.end());
    return sources;
}

std::vector<std::string> hidden_functions(std::string_view source) {
    // Type, name and bracket at the left edge; members are named behind a `::`.
    static const std::regex function(R"(^[A-Za-z_][^=;(]*[ *&>](\w+)\()");
    std::vector<std::string> names;
    std::istringstream lines{std::string(source)};
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "namespace {") inside = true;
        if (line == "}  // namespace") inside = false;
        std::smatch found;
        if (inside && std::regex_search(line, found, function)) names.push_back(found[1]);
    }
    return names;
}

}  // namespace patchlight::walls
