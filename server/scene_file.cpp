#include "server/scene_file.h"

#include "server/files/geometry_file.h"
#include "server/files/known_formats.h"
#include "server/json_document.h"
#include "server/scene_json.h"
#include "server/utf8_text.h"
#include "server/wrong_input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace patchlight::server {
namespace {

/// A byte more than is allowed at most, so that parse_json sees that it is too much.
std::string read_bytes(std::istream& stream) {
    const std::size_t limit = JsonLimits{}.bytes + 1;
    constexpr std::size_t block = std::size_t{1} << 20;
    std::string bytes;
    while (stream && bytes.size() < limit) {
        const std::size_t read = bytes.size();
        bytes.resize(read + block);
        stream.read(bytes.data() + read, block);
        bytes.resize(read + static_cast<std::size_t>(stream.gcount()));
    }
    return bytes;
}

std::string read_file(const std::string& path) {
    if (path == "-") return read_bytes(std::cin);
    if (std::filesystem::is_directory(path)) throw WrongInput(path + ": is a directory");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw WrongInput(path + ": cannot be read: " + std::strerror(errno));
    return read_bytes(file);
}

/// Such as will do for a name.
std::string object_name(const std::filesystem::path& path) {
    std::string name = as_utf8(path.stem().string());
    const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
    std::replace_if(name.begin(), name.end(), is_control, ' ');
    return name;
}

/// A geometry file as a scene of that one file. Places in it say all: no pointers.
Job read_geometry_scene(const std::filesystem::path& path) {
    const nlohmann::json scene{
        {"version", 1},
        {"objects", {{{"name", object_name(path)}, {"file", path.filename().string()}}}}};
    try {
        return read_scene(scene, {path.parent_path()});
    } catch (const InputError& error) {
        const bool is_in_file = error.pointer() == "/objects/0/file";
        const std::string directory = (path.parent_path() / "").string();
        throw WrongInput((is_in_file ? directory : path.string() + ": ") + error.what());
    }
}

}  // namespace

Job read_scene_file(const std::string& path) {
    if (is_geometry_file(path)) return read_geometry_scene(path);
    const std::string bytes = read_file(path);
    if (const std::string what = foreign_name(path); path != "-" && !what.empty())
        throw WrongInput(path + ": " + what);
    SceneSource source;
    if (path != "-") source.directory = std::filesystem::path(path).parent_path();
    Job job;
    naming_file(shown_path(path), [&] { job = read_scene_text(bytes, source); });
    return job;
}

std::string shown_path(const std::string& path) { return path == "-" ? "standard input" : path; }

}  // namespace patchlight::server
