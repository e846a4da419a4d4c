#include "solver/accuracy/energy.h"
#include "solver/accuracy/gathered_light.h"
#include "solver/accuracy/outside_flux.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr int most_balances = 3;  // each leaves what patches' means do not show of the one before

/// Of a number with noise, what is more likely the number than the noise [1].
Rgb trusted(const Rgb& missing, const Rgb& standard_error) {
    return (1.0 - (standard_error / missing.abs().max(1e-300)).square()).max(0.0);
}

}  // namespace

/// Light that is missing of what lamps give off, ∫ H dA in each channel, is missing of the field,
/// and known exactly but for what rays count outside. Where it is missing is not known: it is
/// added in proportion to the light there is, and goes round with the coarse transport.
std::vector<Rgb> GatheredLight::evened_out(const std::vector<Rgb>& irradiance,
                                           double tolerance) const {
    const Rgb noise = energy_.standard_error * energy_.emitted;
    const Rgb missing = energy_.missing() * trusted(energy_.missing(), noise);
    Rgb arriving = Rgb::Zero(), sent_back = Rgb::Zero(), given_off = Rgb::Zero();
    for (PatchIndex i = 0; i < mesh_.size(); ++i) {
        const double area = mesh_.patches[i].area;
        arriving += area * irradiance[i];
        sent_back += area * coarse_->reflectance()[i] * irradiance[i];
        given_off += area * (listed_exitance_[i] + other_exitance_[i]);
    }
    // Without a matrix the whole field grows alike, and so does what is lost of it.
    const Rgb outside =
        (energy_.backs + energy_.escaped) * sent_back / (sent_back + given_off).max(1e-300);
    const Rgb share = coarse_->goes_round()
                          ? Rgb(missing / arriving.max(1e-300))
                          : Rgb(missing / (energy_.absorbed + outside).max(1e-300));
    std::vector<Rgb> extra(irradiance.size()), change(irradiance.size());
    for (std::size_t i = 0; i < extra.size(); ++i) {
        extra[i] = share * irradiance[i];
        change[i] = coarse_->reflectance()[i] * extra[i];
    }
    const CoarseSolution::Correction further = coarse_->correct(change, tolerance);
    for (std::size_t i = 0; i < extra.size(); ++i) extra[i] += further.irradiance[i];
    return extra;
}

void GatheredLight::balance(double tolerance) {
    for (int times = 0;; ++times) {
        const SplitIrradiance means = patch_means(*shown_, mesh_.size());
        std::vector<Rgb> irradiance(mesh_.size());
        for (std::size_t i = 0; i < irradiance.size(); ++i)
            irradiance[i] = means.direct[i] + means.indirect[i];
        energy_ = measure_energy(scene_, mesh_,
                                 measure_outside(scene_, mesh_, shown_->display, rays_,
                                                 energy_aim_.outside_rays, mix(seed_, 0x6f757473)),
                                 irradiance);
        const double known = energy_.defect - energy_.standard_error;
        if (times == most_balances || !(known > energy_aim_.balanced)) return;
        const std::vector<Rgb> extra = evened_out(irradiance, tolerance);
        for (std::size_t i = 0; i < extra.size(); ++i) correction_.irradiance[i] += extra[i];
        shown_ = pass_.show(correction_.irradiance);
    }
}

}  // namespace patchlight
