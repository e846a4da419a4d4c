#include "raster/image_module.h"

#include <dlfcn.h>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace patchlight::raster {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "patchlight_image.so";

std::vector<fs::path> candidates() {
    if (const char* const named = ::secure_getenv("PATCHLIGHT_IMAGE_MODULE"); named && *named)
        return {named};
    std::vector<fs::path> paths;
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    if (!unknown) {
        paths.push_back(program.parent_path() / file_name);
        paths.push_back(program.parent_path().parent_path() / "lib" / "patchlight" / file_name);
    }
    paths.push_back(fs::path(PATCHLIGHT_INSTALLED_MODULE_DIR) / file_name);
    paths.push_back(fs::path(PATCHLIGHT_BUILT_MODULE_DIR) / file_name);
    return paths;
}

/// The outcome of looking for the module, once per process.
struct Search {
    PatchlightEncodeImage encoder = nullptr;
    PatchlightMeanColour averager = nullptr;
    std::string tried;  // a line for each file that did not do

    Search() noexcept {
        try {
            for (const fs::path& path : candidates())
                if (load(path)) return;
        } catch (const std::exception& problem) {
            tried += problem.what();
        }
    }

  private:
    bool load(const fs::path& path) {
        // Never closed: the libraries behind it do not survive that.
        void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        const auto find = [&](const char* name) {
            return module ? ::dlsym(module, name) : nullptr;
        };
        encoder = reinterpret_cast<PatchlightEncodeImage>(find(patchlight_encode_image_name));
        if (encoder)
            averager = reinterpret_cast<PatchlightMeanColour>(find(patchlight_mean_colour_name));
        if (averager) return true;
        tried += "\n  " + path.string() + ": " + ::dlerror();
        return false;
    }
};

/// Waits if another thread is at it.
const Search& search() {
    static const Search result;
    return result;
}

/// A thread that looks for the module.
class BackgroundSearch {
  public:
    BackgroundSearch() noexcept {
        try {
            thread_ = std::thread([] { search(); });
        } catch (const std::system_error&) {
            // No thread to be had: image_encoder loads when it is asked.
        }
    }
    ~BackgroundSearch() { wait(); }
    BackgroundSearch(const BackgroundSearch&) = delete;
    BackgroundSearch& operator=(const BackgroundSearch&) = delete;

    void wait() {
        const std::lock_guard lock(joining_);
        if (thread_.joinable()) thread_.join();
    }

  private:
    std::thread thread_;
    std::mutex joining_;
};

/// Waits for the search when the thread that owns it ends. For the main thread that is before the
/// first static object is destroyed; a static object would wait too late, as those of the libraries
/// that are already loaded are younger and so are destroyed before it, under the loader's feet.
struct WaitAtThreadEnd {
    BackgroundSearch& search;

    ~WaitAtThreadEnd() { search.wait(); }
};

}  // namespace

void preload_image_codec() {
    static BackgroundSearch background;
    thread_local const WaitAtThreadEnd wait{background};
    static_cast<void>(wait);
}

namespace {

const Search& found() {
    const Search& result = search();
    if (!result.averager)
        throw std::runtime_error("the image module cannot be loaded; tried" + result.tried);
    return result;
}

}  // namespace

PatchlightEncodeImage image_encoder() { return found().encoder; }

PatchlightMeanColour image_averager() { return found().averager; }

}  // namespace patchlight::raster
