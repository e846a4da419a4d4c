#include "server/output_files.h"

#include "server/output_stream.h"
#include "server/wrong_input.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

namespace patchlight::server {

namespace fs = std::filesystem;

void require_writable(const std::string& option, const std::string& path) {
    const auto refuse = [&](const std::string& why) {
        throw WrongInput(option + " " + path + ": " + why);
    };
    if (path.empty()) refuse("the name is empty");
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    if (fs::is_directory(status)) refuse("is a directory");
    const bool is_replaced = !fs::exists(status) || fs::is_regular_file(status);
    if (!is_replaced) {
        if (access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
        return;
    }
    const fs::path parent = fs::path(path).parent_path();
    const fs::path directory = parent.empty() ? fs::path(".") : parent;
    if (!fs::is_directory(directory, unknown))
        refuse("there is no directory " + directory.string());
    if (access(directory.c_str(), W_OK | X_OK) != 0)
        refuse("directory " + directory.string() +
               " cannot be written to: " + std::strerror(errno));
}

bool has_ending(std::string_view name, std::string_view ending) {
    if (name.size() < ending.size()) return false;
    const auto is_same = [](char small, char letter) {
        const bool is_capital = letter >= 'A' && letter <= 'Z';
        return (is_capital ? static_cast<char>(letter - 'A' + 'a') : letter) == small;
    };
    return std::equal(ending.begin(), ending.end(), name.end() - std::ssize(ending), is_same);
}

void require_ending(const std::string& option, const std::string& path,
                    std::initializer_list<std::string_view> endings) {
    const auto is_right = [&](std::string_view ending) { return has_ending(path, ending); };
    if (endings.size() == 0 || std::any_of(endings.begin(), endings.end(), is_right)) return;
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    if (fs::exists(status) && fs::is_other(status)) return;
    std::string known;
    for (const std::string_view ending : endings)
        known.append(known.empty() ? "" : " or ").append(ending);
    throw WrongInput(option + " " + path + ": the name must end in " + known);
}

void require_different(const std::vector<std::string>& paths) {
    std::set<fs::path> seen;
    for (const std::string& path : paths) {
        if (path == to_standard_output) {
            if (!seen.insert(path).second)
                throw WrongInput("two outputs would be written to standard output");
            continue;
        }
        std::error_code unknown;
        const fs::path real = fs::weakly_canonical(fs::absolute(path), unknown);
        if (!seen.insert(unknown ? fs::path(path) : real).second)
            throw WrongInput(path + ": two outputs would be written to it");
    }
}

void require_not_read(const std::vector<std::string>& outputs, const std::vector<fs::path>& read) {
    for (const std::string& output : outputs)
        for (const fs::path& input : read) {
            std::error_code neither_is_there;
            if (output != to_standard_output && fs::is_regular_file(input, neither_is_there) &&
                fs::equivalent(output, input, neither_is_there))
                throw WrongInput(output + ": is read, and would be lost; write to another file");
        }
}

}  // namespace patchlight::server
