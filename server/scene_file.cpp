#include "server/scene_file.h"

#include "server/json_document.h"
#include "server/not_built.h"
#include "server/scene_json.h"
#include "server/wrong_input.h"

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

void refuse_geometry_file(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& letter : ending)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    if (const std::string why = why_not_built(ending); !why.empty())
        throw WrongInput(path + ": " + why);
}

}  // namespace

Job read_scene_file(const std::string& path) {
    refuse_geometry_file(path);
    const std::string bytes = read_file(path);
    Job job;
    naming_file(shown_path(path), [&] { job = read_scene_text(bytes); });
    return job;
}

std::string shown_path(const std::string& path) { return path == "-" ? "standard input" : path; }

}  // namespace patchlight::server
