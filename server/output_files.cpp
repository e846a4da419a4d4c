#include "server/output_files.h"

#include "server/wrong_input.h"

#include <unistd.h>

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

void require_different(const std::vector<std::string>& paths) {
    std::set<fs::path> seen;
    for (const std::string& path : paths) {
        std::error_code unknown;
        const fs::path real = fs::weakly_canonical(fs::absolute(path), unknown);
        if (!seen.insert(unknown ? fs::path(path) : real).second)
            throw WrongInput(path + ": two outputs would be written to it");
    }
}

}  // namespace patchlight::server
