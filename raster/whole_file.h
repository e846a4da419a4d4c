#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace patchlight::raster {

/// A file that is written piece by piece and is there whole or not at all: what is written lies
/// beside it until `commit` puts it in its place by renaming. Without `commit` nothing is changed.
/// What is there and is no regular file (a pipe, /dev/stdout) is written to as it is. All throw
/// std::system_error with errno and the path.
class WholeFile {
  public:
    explicit WholeFile(std::filesystem::path path);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void write(std::string_view bytes);

    /// Puts bytes in the place of as many that were written before. No pipe allows it.
    void overwrite(std::uint64_t offset, std::string_view bytes);

    /// Synced to disk, then renamed. Nothing may be written after it.
    void commit();

  private:
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    std::filesystem::path target_;   // where the path leads through links
    std::filesystem::path written_;  // beside the target; empty: written in place
    int descriptor_ = -1;
};

}  // namespace patchlight::raster
