#include "solver/accuracy/coarse_solution.h"

#include "solver/transport/patch_fields.h"

#include <cmath>
#include <utility>

namespace patchlight {

CoarseSolution::CoarseSolution(const Scene& scene, const PatchMesh& mesh,
                               const CoarseTransport& transport, std::vector<Rgb> other_exitance)
    : transport_(transport), other_exitance_(std::move(other_exitance)) {
    channels_ = make_patch_fields(scene, mesh).exitance.size();
    for (const Patch& patch : mesh.patches) {
        area_.push_back(patch.area);
        reflectance_.push_back(scene.materials[scene.surfaces[patch.surface].material].reflectance);
    }
}

Field CoarseSolution::to_field(const std::vector<Rgb>& values) const {
    Field field(channels_, std::vector<double>(values.size()));
    for (std::size_t c = 0; c < channels_; ++c)
        for (std::size_t i = 0; i < values.size(); ++i)
            field[c][i] = values[i][static_cast<Eigen::Index>(c)];
    return field;
}

double CoarseSolution::norm_of(const std::vector<Rgb>& values) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double y = luminance(values[i]);
        sum += area_[i] * y * y;
    }
    return std::sqrt(sum);
}

bool CoarseSolution::solve(const std::vector<Rgb>& direct, double tolerance,
                           const CoarseTransport::Observe& observe) {
    std::vector<Rgb> once(direct.size());
    for (std::size_t i = 0; i < direct.size(); ++i)
        once[i] = other_exitance_[i] + reflectance_[i] * direct[i];
    transported_ = transport_.solve(to_field(once), tolerance, observe);
    reflected_ = to_rgb(transported_.radiosity);
    irradiance_ = to_rgb(transported_.irradiance);
    std::vector<Rgb> sent_back = reflected_;
    for (std::size_t i = 0; i < sent_back.size(); ++i) sent_back[i] -= other_exitance_[i];
    norm_ = norm_of(sent_back);
    return transported_.stopped_by == StopReason::tolerance ||
           transported_.stopped_by == StopReason::iteration_limit;
}

CoarseSolution::Correction CoarseSolution::correct(const std::vector<Rgb>& change,
                                                   double tolerance) const {
    Correction correction{std::vector<Rgb>(change.size(), Rgb::Zero()), 0.0};
    if (!(norm_ > 0.0)) return correction;
    const std::optional<Field> arriving = transport_.once(to_field(change));
    if (!arriving) {  // no matrix to send it on with: how much it is can be told, not where
        correction.size = norm_of(change) / norm_;
        return correction;
    }
    const std::vector<Rgb> onward = to_rgb(*arriving);
    std::vector<Rgb> source(change.size());
    for (std::size_t i = 0; i < change.size(); ++i) source[i] = reflectance_[i] * onward[i];
    const Transported changed = transport_.solve(to_field(source), tolerance, {});
    const std::vector<Rgb> further = to_rgb(changed.irradiance);
    for (std::size_t i = 0; i < change.size(); ++i)
        correction.irradiance[i] = onward[i] + further[i];
    correction.size = norm_of(to_rgb(changed.radiosity)) / norm_;
    return correction;
}

std::optional<std::vector<Rgb>> CoarseSolution::gone_round(const std::vector<Rgb>& missing,
                                                           double tolerance) const {
    std::vector<Rgb> source(missing.size(), Rgb::Zero());
    for (std::size_t i = 0; i < missing.size(); ++i)
        if (area_[i] > 0.0) source[i] = reflectance_[i] * missing[i] / area_[i];
    if (!transport_.has_matrix()) return std::nullopt;
    return to_rgb(transport_.solve(to_field(source), tolerance, {}).radiosity);
}

}  // namespace patchlight
