#include "server/chart/run_gnuplot.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

extern char** environ;

namespace patchlight::server {
namespace {

/// A file in memory: neither side waits for the other, as they may with pipes.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view bytes = {})
        : descriptor_(memfd_create("gnuplot", MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::runtime_error("no memory for gnuplot's script");
        while (!bytes.empty()) {
            const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno != EINTR)
                throw std::runtime_error("no memory for gnuplot's script");
            if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        lseek(descriptor_, 0, SEEK_SET);
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int descriptor() const { return descriptor_; }
    std::string bytes() const {
        lseek(descriptor_, 0, SEEK_SET);
        std::string all;
        std::array<char, 1 << 16> piece;
        for (ssize_t count = 0; (count = read(descriptor_, piece.data(), piece.size())) > 0;)
            all.append(piece.data(), static_cast<std::size_t>(count));
        return all;
    }

  private:
    int descriptor_;
};

/// In a process group of its own, so that Ctrl-C leaves it alone. Returns 0 or errno.
int start_gnuplot(const MemoryFile& in, const MemoryFile& out, const MemoryFile& err, pid_t& pid) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, err.descriptor(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string name = "gnuplot", no_user_settings = "-d";
    std::array<char*, 3> arguments{name.data(), no_user_settings.data(), nullptr};
    const int failure =
        posix_spawnp(&pid, name.c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return failure;
}

/// How the process ended, as waitpid says it; empty: it took too long and was ended.
std::optional<int> wait_for(pid_t pid, std::chrono::seconds most) {
    const auto end = std::chrono::steady_clock::now() + most;
    int status = 0;
    for (;;) {
        const pid_t ended = waitpid(pid, &status, WNOHANG);
        if (ended == pid) return status;
        if ((ended < 0 && errno != EINTR) || std::chrono::steady_clock::now() > end) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    return std::nullopt;
}

std::string first_line(const std::string& text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \n\r\t"), text.size());
    return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

GnuplotRun run_gnuplot(const std::string& script, std::chrono::seconds most) {
    const MemoryFile in(script), out, err;
    pid_t pid = 0;
    if (const int failure = start_gnuplot(in, out, err, pid))
        return {"", failure == ENOENT
                        ? "gnuplot is not installed"
                        : std::string("gnuplot cannot be run: ") + std::strerror(failure)};
    const std::optional<int> status = wait_for(pid, most);
    if (!status) return {"", "gnuplot took longer than " + std::to_string(most.count()) + " s"};
    if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0)
        return {"", "gnuplot failed: " + first_line(err.bytes())};
    std::string output = out.bytes();
    if (output.empty()) return {"", "gnuplot drew nothing: " + first_line(err.bytes())};
    return {std::move(output), ""};
}

}  // namespace patchlight::server
