#include "raster/write_whole.h"

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

[[noreturn]] void fail(const fs::path& path) {
    throw std::system_error(errno, std::generic_category(), path.string());
}

class OpenFile {
  public:
    OpenFile(const fs::path& path, int flags)
        : descriptor_(::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    bool is_open() const { return descriptor_ >= 0; }
    bool write(std::string_view bytes) const {
        while (!bytes.empty()) {
            const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }
    bool sync() const { return ::fsync(descriptor_) == 0; }
    bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

  private:
    int descriptor_;
};

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

void write_in_place(const fs::path& path, std::string_view bytes) {
    OpenFile file(path, 0);
    if (!file.is_open() || !file.write(bytes) || !file.close()) fail(path);
}

}  // namespace

void write_whole(const fs::path& path, std::string_view bytes) {
    std::error_code absent;
    const fs::file_status status = fs::status(path, absent);
    if (fs::exists(status) && !fs::is_regular_file(status)) return write_in_place(path, bytes);
    const fs::path target = behind_links(path);
    const fs::path written = name_beside(target);
    OpenFile file(written, O_CREAT | O_EXCL);
    if (!file.is_open()) fail(path);
    if (file.write(bytes) && file.sync() && file.close() &&
        ::rename(written.c_str(), target.c_str()) == 0)
        return;
    const int reason = errno;
    ::unlink(written.c_str());
    errno = reason;
    fail(path);
}

}  // namespace patchlight::raster
