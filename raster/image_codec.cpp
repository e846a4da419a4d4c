#include "raster/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <exception>
#include <stdexcept>
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

std::vector<unsigned char> encode(const PatchlightImageRequest& request) {
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

}  // namespace

extern "C" __attribute__((visibility("default"))) int patchlight_encode_image_1(
    const PatchlightImageRequest* request) {
    try {
        const std::vector<unsigned char> bytes = encode(*request);
        request->take_bytes(request->taker, bytes.data(), bytes.size());
        return 0;
    } catch (const std::exception& problem) {
        request->take_problem(request->taker, problem.what());
    } catch (...) {
        request->take_problem(request->taker, "unknown failure");
    }
    return 1;
}
