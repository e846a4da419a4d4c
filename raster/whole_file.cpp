#include "raster/whole_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace patchlight::raster {
namespace {

namespace fs = std::filesystem;

/// A name beside the target that nobody else picks; short, whatever the length of the target's.
fs::path name_beside(const fs::path& target) {
    static std::atomic<unsigned> count{0};
    return target.parent_path() /
           (".patchlight-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
}

/// Where a link points, as renaming would replace the link.
fs::path behind_links(const fs::path& path) {
    std::error_code unresolved;
    const fs::path target =
        fs::is_symlink(path, unresolved) ? fs::canonical(path, unresolved) : path;
    return unresolved ? path : target;
}

bool is_written_in_place(const fs::path& path) {
    std::error_code absent;
    const fs::file_status status = fs::status(path, absent);
    return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

WholeFile::WholeFile(fs::path path) : path_(std::move(path)) {
    int flags = O_WRONLY | O_CLOEXEC;
    if (is_written_in_place(path_)) {
        target_ = path_;
    } else {
        target_ = behind_links(path_);
        written_ = name_beside(target_);
        flags |= O_CREAT | O_EXCL;
    }
    descriptor_ = ::open((written_.empty() ? target_ : written_).c_str(), flags, 0666);
    if (descriptor_ < 0) fail();
}

WholeFile::~WholeFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!written_.empty()) ::unlink(written_.c_str());
}

void WholeFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

void WholeFile::overwrite(std::uint64_t offset, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        bytes.remove_prefix(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
}

void WholeFile::commit() {
    const bool is_synced = written_.empty() || ::fsync(descriptor_) == 0;
    if (!is_synced || ::close(std::exchange(descriptor_, -1)) != 0) fail();
    if (written_.empty()) return;
    if (::rename(written_.c_str(), target_.c_str()) != 0) fail();
    written_.clear();
}

void WholeFile::fail() const {
    throw std::system_error(errno, std::generic_category(), path_.string());
}

}  // namespace patchlight::raster
