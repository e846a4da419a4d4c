#include "server/files/file_bytes.h"

#include "solver/scene/input_error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace patchlight::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{512} << 20;

}  // namespace

std::string read_file_bytes(const fs::path& path, const std::string& shown) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) throw InputError(shown, "is a directory");
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw InputError(shown, "is no regular file");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(shown, std::string("cannot be read: ") + std::strerror(errno));
    const std::uintmax_t size = fs::file_size(path, ignored);
    if (ignored || size > most_bytes)
        throw InputError(shown, "has " + std::to_string(size) + " bytes; the limit is " +
                                    std::to_string(most_bytes));
    std::string bytes(size, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

std::string first_bytes(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return "";
    constexpr std::size_t most = std::size_t{64} << 10;
    std::ifstream file(path, std::ios::binary);
    std::string bytes(most, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(most));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return bytes;
}

std::optional<fs::path> file_beside(const fs::path& file, const std::string& reference) {
    const fs::path relative(reference);
    if (relative.is_absolute() || reference.find('\0') != std::string::npos) return std::nullopt;
    std::error_code failure;
    const fs::path directory = fs::weakly_canonical(fs::absolute(file).parent_path(), failure);
    if (failure) return std::nullopt;
    const fs::path wanted = fs::weakly_canonical(directory / relative, failure);
    if (failure) return std::nullopt;
    const auto split =
        std::mismatch(directory.begin(), directory.end(), wanted.begin(), wanted.end());
    if (split.first != directory.end()) return std::nullopt;
    return wanted;
}

}  // namespace patchlight::server
