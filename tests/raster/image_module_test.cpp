#include "raster/image_module.h"

#include "raster/image_file.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace patchlight::raster::image_module_test {
namespace {

// The module is looked for once per process, so each case has a process of its own.
class ImageModule : public testing::Test {
  protected:
    ImageModule() { testing::GTEST_FLAG(death_test_style) = "threadsafe"; }
};

const Image grey{1, 1, {0.5F, 0.5F, 0.5F}};

bool is_loaded() {
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find("OpenImageIO") != std::string::npos;
}

TEST_F(ImageModule, IsNotLoadedUntilAPictureNeedsIt) {
    EXPECT_EXIT(
        {
            encode_pfm(grey);
            const bool before = is_loaded();
            encode_png(grey, 0.0);
            std::exit(!before && is_loaded() ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(ImageModule, IsLoadedInTheBackground) {
    EXPECT_EXIT(
        {
            preload_image_codec();
            preload_image_codec();
            for (int i = 0; i < 1000 && !is_loaded(); ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            std::exit(is_loaded() && !encode_exr(grey).empty() ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(ImageModule, AProgramMayEndWhileItIsLoaded) {
    for (const int delay : {0, 1, 5, 20, 50, 100}) {
        EXPECT_EXIT(
            {
                preload_image_codec();
                std::this_thread::sleep_for(std::chrono::milliseconds(delay));
                std::exit(0);
            },
            testing::ExitedWithCode(0), "");
    }
}

TEST_F(ImageModule, ThatIsAbsentIsNamed) {
    EXPECT_EXIT(
        {
            ::setenv("PATCHLIGHT_IMAGE_MODULE", "/nowhere/codec.so", 1);
            preload_image_codec();
            try {
                encode_png(grey, 0.0);
            } catch (const std::runtime_error& error) {
                std::fputs(error.what(), stderr);
            }
            encode_pfm(grey);
            std::exit(0);
        },
        testing::ExitedWithCode(0), "tried\n  /nowhere/codec.so: .*No such file");
}

TEST_F(ImageModule, ThatIsAnotherLibraryIsRefused) {
    EXPECT_EXIT(
        {
            ::setenv("PATCHLIGHT_IMAGE_MODULE", "libm.so.6", 1);
            try {
                encode_exr(grey);
            } catch (const std::runtime_error& error) {
                std::fputs(error.what(), stderr);
            }
            std::exit(0);
        },
        testing::ExitedWithCode(0), "undefined symbol: patchlight_encode_image_1");
}

}  // namespace
}  // namespace patchlight::raster::image_module_test
