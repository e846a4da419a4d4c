#include "raster/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// Pools of threads, of OpenImageIO and of OpenEXR below it, have dead-locked when a program ends.
void use_no_pools() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);  // 1 is a pool of one thread, -1 is none
        return true;
    }();
    static_cast<void>(done);
}

OIIO::ImageSpec spec_of(const PatchlightImageRequest& request) {
    switch (request.format) {
        case patchlight_png: {
            OIIO::ImageSpec spec(request.width, request.height, 3, OIIO::TypeDesc::UINT8);
            spec.attribute("oiio:ColorSpace", "sRGB");
            return spec;
        }
        case patchlight_exr: {
            OIIO::ImageSpec spec(request.width, request.height, 3, OIIO::TypeDesc::FLOAT);
            spec.attribute("oiio:ColorSpace", "Linear");
            spec.attribute("compression", "zip");
            // Else the time of writing is put here, and the same image differs each second.
            spec.attribute("DateTime", "1970:01:01 00:00:00");
            return spec;
        }
    }
    throw std::invalid_argument("format without a case");
}

std::vector<unsigned char> encode_pixels(const PatchlightImageRequest& request) {
    use_no_pools();
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto file = OIIO::ImageOutput::create(
        request.format == patchlight_png ? "memory.png" : "memory.exr", &memory);
    if (!file) throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec spec = spec_of(request);
    if (!file->open("memory", spec) || !file->write_image(spec.format, request.pixels) ||
        !file->close())
        throw std::runtime_error(file->geterror());
    return bytes;
}

constexpr long long most_pixels = 1LL << 27;  // a picture of 100 kB may unfold to more

/// By its first bytes: what a picture is called may be wrong.
const char* name_by_content(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "memory.png";
    if (bytes.starts_with("\xFF\xD8\xFF")) return "memory.jpg";
    if (bytes.starts_with("\x76\x2F\x31\x01")) return "memory.exr";
    throw std::runtime_error("is no PNG, JPEG or EXR");
}

/// sRGB to linear light (IEC 61966-2-1).
double linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Sums of colour, each weighted by its opacity or all alike.
class ColourSum {
  public:
    ColourSum(const OIIO::ImageSpec& spec, bool is_encoded, bool by_opacity)
        : channels_(spec.nchannels),
          opacity_(by_opacity && spec.alpha_channel >= 0 ? spec.alpha_channel : -1),
          is_grey_(spec.nchannels < 3),
          is_encoded_(is_encoded) {
        for (int code = 0; code < 256; ++code) by_code_[code] = linear(code / 255.0);
    }

    /// Bytes are looked up: they are by far the most common.
    void add(const float* pixel) {
        const double weight = opacity_ < 0 ? 1.0 : std::clamp(double{pixel[opacity_]}, 0.0, 1.0);
        weight_ += weight;
        for (int c = 0; c < 3; ++c) sum_[c] += weight * light(pixel[is_grey_ ? 0 : c]);
    }

    void mean(double* rgb) const {
        for (int c = 0; c < 3; ++c) rgb[c] = weight_ > 0.0 ? sum_[c] / weight_ : 0.0;
    }
    int channels() const { return channels_; }

  private:
    double light(float value) const {
        if (!is_encoded_) return value;
        const float code = value * 255.0f;
        const float whole = std::round(code);
        const bool is_byte = whole >= 0.0f && whole <= 255.0f && std::abs(code - whole) < 1e-3f;
        return is_byte ? by_code_[static_cast<int>(whole)] : linear(value);
    }

    int channels_;
    int opacity_;
    bool is_grey_;
    bool is_encoded_;
    std::array<double, 256> by_code_{};
    double weight_ = 0.0;
    std::array<double, 3> sum_{};
};

std::array<double, 3> mean_colour(const PatchlightMeanRequest& request) {
    use_no_pools();
    const std::string_view bytes(static_cast<const char*>(request.bytes), request.count);
    const std::string name = name_by_content(bytes);
    OIIO::Filesystem::IOMemReader memory(request.bytes, request.count);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOProxy* const proxy = &memory;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto file = OIIO::ImageInput::open(name, &config, &memory);
    if (!file) throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec spec = file->spec();
    if (static_cast<long long>(spec.width) * spec.height > most_pixels)
        throw std::runtime_error("has more than 134 million pixels");
    ColourSum sum(spec, !name.ends_with(".exr"), request.by_opacity != 0);
    constexpr int rows_at_a_time = 64;
    std::vector<float> rows(static_cast<std::size_t>(spec.width) * rows_at_a_time *
                            static_cast<std::size_t>(spec.nchannels));
    for (int y = 0; y < spec.height; y += rows_at_a_time) {
        const int count = std::min(rows_at_a_time, spec.height - y);
        if (!file->read_scanlines(0, 0, spec.y + y, spec.y + y + count, 0, 0, spec.nchannels,
                                  OIIO::TypeDesc::FLOAT, rows.data()))
            throw std::runtime_error(file->geterror());
        for (int k = 0; k < count * spec.width; ++k)
            sum.add(&rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(sum.channels())]);
    }
    std::array<double, 3> mean{};
    sum.mean(mean.data());
    for (const double channel : mean)
        if (!std::isfinite(channel)) throw std::runtime_error("has pixels that are not finite");
    return mean;
}

/// No exception leaves the module.
template <typename Request, typename Work>
int answer(const Request& request, const Work& work) noexcept {
    try {
        work();
        return 0;
    } catch (const std::exception& problem) {
        request.take_problem(request.taker, problem.what());
    } catch (...) {
        request.take_problem(request.taker, "unknown failure");
    }
    return 1;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int patchlight_encode_image_1(
    const PatchlightImageRequest* request) {
    return answer(*request, [&] {
        const std::vector<unsigned char> bytes = encode_pixels(*request);
        request->take_bytes(request->taker, bytes.data(), bytes.size());
    });
}

extern "C" __attribute__((visibility("default"))) int patchlight_mean_colour_1(
    const PatchlightMeanRequest* request) {
    return answer(*request, [&] {
        const std::array<double, 3> mean = mean_colour(*request);
        request->take_mean(request->taker, mean.data());
    });
}
