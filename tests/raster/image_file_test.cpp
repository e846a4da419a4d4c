#include "raster/image_file.h"

#include "raster/tone.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

namespace patchlight::raster::image_file_test {
namespace {

/// What another program reads from a file.
template <class Value>
struct Decoded {
    OIIO::ImageSpec spec;
    std::vector<Value> values;
};

template <class Value>
Decoded<Value> decoded(const std::string& bytes, const char* name) {
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto file = OIIO::ImageInput::open(name, nullptr, &memory);
    if (!file) throw std::runtime_error(OIIO::geterror());
    Decoded<Value> result{file->spec(), std::vector<Value>(file->spec().image_pixels() * 3)};
    file->read_image(0, 0, 0, 3, OIIO::BaseTypeFromC<Value>::value, result.values.data());
    return result;
}

/// Every value differs from every other.
Image gradient(int width, int height) {
    Image image{width, height, {}};
    for (int i = 0; i < 3 * width * height; ++i)
        image.rgb.push_back(static_cast<float>(i + 1) / static_cast<float>(2 * width * height));
    return image;
}

TEST(Pfm, IsByteForByteAsTheFormatSays) {
    const Image image{1, 2, {1.0F, 0.0F, -2.0F, 0.5F, 0.25F, 3.0F}};
    const std::string header = "PF\n1 2\n-1.0\n";
    const std::string bottom_row("\0\0\0\x3f\0\0\x80\x3e\0\0\x40\x40", 12);
    const std::string top_row("\0\0\x80\x3f\0\0\0\0\0\0\0\xc0", 12);
    EXPECT_EQ(encode_pfm(image), header + bottom_row + top_row);
}

TEST(Pfm, IsReadBackByOthers) {
    const Image image = gradient(7, 5);
    EXPECT_EQ(decoded<float>(encode_pfm(image), "picture.pfm").values.size(), image.rgb.size());
}

TEST(Png, HoldsToneMappedBytesTopRowFirst) {
    const Image image = gradient(33, 20);
    const auto png = decoded<unsigned char>(encode_png(image, 0.5), "picture.png");
    EXPECT_EQ(png.spec.width, 33);
    EXPECT_EQ(png.spec.height, 20);
    EXPECT_EQ(png.spec.nchannels, 3);
    EXPECT_EQ(png.spec.format, OIIO::TypeUInt8);
    EXPECT_EQ(png.values, tone_mapped(image, 0.5));
}

TEST(Exr, HoldsExactlyTheFloatsTopRowFirst) {
    Image image = gradient(33, 20);
    image.rgb[0] = 1e30F;
    image.rgb[1] = 1e-40F;
    image.rgb[2] = std::numeric_limits<float>::infinity();
    const auto exr = decoded<float>(encode_exr(image), "picture.exr");
    EXPECT_EQ(exr.spec.format, OIIO::TypeFloat);
    EXPECT_EQ(exr.spec.channelnames, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(exr.spec.get_string_attribute("compression"), "zip");
    EXPECT_EQ(exr.values, image.rgb);
}

TEST(ImageFile, TheSameImageIsTheSameFileASecondLater) {
    const Image image = gradient(40, 30);
    const std::string exr = encode_exr(image);
    const std::string png = encode_png(image, 0.0);
    const std::string pfm = encode_pfm(image);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_EQ(encode_exr(image), exr);
    EXPECT_EQ(encode_png(image, 0.0), png);
    EXPECT_EQ(encode_pfm(image), pfm);
}

TEST(ImageFile, ThreadsMayEncodeAtOnce) {
    const Image image = gradient(60, 50);
    const std::string exr = encode_exr(image);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (int k = 0; k < 10; ++k) EXPECT_EQ(encode_exr(image), exr);
        });
    for (std::thread& thread : threads) thread.join();
}

TEST(ImageFile, RefusesAnImageWhoseSizeDoesNotFit) {
    const Image image{2, 2, {1.0F, 2.0F, 3.0F}};
    EXPECT_THROW(encode_pfm(image), std::invalid_argument);
    EXPECT_THROW(encode_png(image, 0.0), std::invalid_argument);
    EXPECT_THROW(encode_exr({}), std::invalid_argument);
}

}  // namespace
}  // namespace patchlight::raster::image_file_test
