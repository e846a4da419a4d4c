#include "raster/mean_colour.h"

#include "raster/image_codec.h"
#include "raster/image_module.h"

#include <new>
#include <stdexcept>
#include <string>

namespace patchlight::raster {
namespace {

/// What the module hands back. No exception may cross it, so lack of memory is noted instead.
struct MeanAnswer {
    Eigen::Array3d mean = Eigen::Array3d::Zero();
    std::string problem;
    bool out_of_memory = false;
};

void take_mean(void* taker, const double* linear_rgb) {
    static_cast<MeanAnswer*>(taker)->mean = Eigen::Map<const Eigen::Array3d>(linear_rgb);
}

void take_mean_problem(void* taker, const char* text) {
    auto& answer = *static_cast<MeanAnswer*>(taker);
    try {
        answer.problem = text;
    } catch (const std::bad_alloc&) {
        answer.out_of_memory = true;
    }
}

}  // namespace

Eigen::Array3d mean_colour(std::string_view bytes, bool by_opacity) {
    MeanAnswer answer;
    const PatchlightMeanRequest request = {bytes.data(), bytes.size(),      by_opacity ? 1 : 0,
                                           take_mean,    take_mean_problem, &answer};
    const bool is_read = image_averager()(&request) == 0;
    if (answer.out_of_memory) throw std::bad_alloc();
    if (!is_read) throw std::runtime_error(answer.problem);
    return answer.mean;
}

}  // namespace patchlight::raster
