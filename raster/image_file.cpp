#include "raster/image_file.h"

#include "raster/image_codec.h"
#include "raster/image_module.h"
#include "raster/tone.h"

#include <bit>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <utility>

namespace patchlight::raster {
namespace {

/// What the module hands back. No exception may cross it, so lack of memory is noted instead.
struct Answer {
    std::string bytes;
    std::string problem;
    bool out_of_memory = false;
};

template <class Take>
void noting_lack_of_memory(void* taker, const Take& take) noexcept {
    auto& answer = *static_cast<Answer*>(taker);
    try {
        take(answer);
    } catch (const std::bad_alloc&) {
        answer.out_of_memory = true;
    }
}

void take_bytes(void* taker, const unsigned char* bytes, std::size_t count) {
    noting_lack_of_memory(taker,
                          [&](Answer& answer) { answer.bytes.assign(bytes, bytes + count); });
}

void take_problem(void* taker, const char* text) {
    noting_lack_of_memory(taker, [&](Answer& answer) { answer.problem = text; });
}

std::string encode(PatchlightImageFormat format, const Image& image, const void* pixels) {
    Answer answer;
    const PatchlightImageRequest request = {format,     image.width,  image.height, pixels,
                                            take_bytes, take_problem, &answer};
    const bool encoded = image_encoder()(&request) == 0;
    if (answer.out_of_memory) throw std::bad_alloc();
    if (!encoded) throw std::runtime_error("image cannot be encoded: " + answer.problem);
    return std::move(answer.bytes);
}

void require_whole(const Image& image) {
    const auto pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.width < 1 || image.height < 1 || image.rgb.size() != 3 * pixels)
        throw std::invalid_argument("image: its size does not match its pixels");
}

void append_little_endian(std::string& bytes, float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

}  // namespace

std::string encode_png(const Image& image, double exposure) {
    require_whole(image);
    return encode(patchlight_png, image, tone_mapped(image, exposure).data());
}

std::string encode_exr(const Image& image) {
    require_whole(image);
    return encode(patchlight_exr, image, image.rgb.data());
}

std::string encode_pfm(const Image& image) {
    require_whole(image);
    std::string bytes =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    bytes.reserve(bytes.size() + 4 * image.rgb.size());
    const std::size_t row_size = 3 * static_cast<std::size_t>(image.width);
    for (auto row = static_cast<std::size_t>(image.height); row-- > 0;)
        for (std::size_t i = 0; i < row_size; ++i)
            append_little_endian(bytes, image.rgb[row * row_size + i]);
    return bytes;
}

}  // namespace patchlight::raster
