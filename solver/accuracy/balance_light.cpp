#include "solver/accuracy/energy.h"
#include "solver/accuracy/gathered_light.h"
#include "solver/accuracy/outside_flux.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr double balanced = 0.02;        // of the target, that may be missing of the energy
constexpr double usually_missing = 0.3;  // of the target, as estimates are about three times errors
constexpr double noise_of_outside = 0.25;  // of the target, in what goes astray
constexpr double noise_of_backs = 0.25;    // of that, where it is gathered at backs
constexpr std::size_t fewest_outside_rays = 4096, first_outside_rays = 262144,
                      most_outside_rays = 131072, fewest_back_rays = 16384;
constexpr double sure_to_differ = 3.0;  // standard errors
constexpr int most_balances = 3;  // each leaves what patches' means do not show of the one before

/// Of what is missing, the part that is no noise: the mean of what may be behind it, where `likely`
/// is usually missing, or as much as is beyond three standard errors [1].
Rgb trusted(const Rgb& missing, const Rgb& standard_error, const Rgb& likely) {
    const Rgb noise = standard_error.square(),
              prior = likely.square().max(missing.square() - 9.0 * noise);
    return prior / (prior + noise).max(1e-300);
}

}  // namespace

EnergyAim energy_aim_for(double target, bool is_open, bool meets_backs) {
    EnergyAim aim;
    aim.balanced = balanced * target;
    aim.likely = usually_missing * target;
    aim.noise = noise_of_outside * target;
    if (is_open)
        aim.outside_rays = static_cast<std::size_t>(
            std::clamp(std::pow(0.5 / aim.noise, 2), static_cast<double>(fewest_outside_rays),
                       static_cast<double>(first_outside_rays)));
    if (meets_backs) aim.back_rays = std::max(aim.outside_rays, fewest_back_rays);
    return aim;
}

/// Light that is missing of what lamps give off, ∫ H dA in each channel, is missing of the field,
/// and known but for what rays count outside. Where it is missing is not known: it is added in
/// proportion to the light there is, and goes round with the coarse transport.
std::vector<Rgb> GatheredLight::evened_out(const Rgb& missing, const std::vector<Rgb>& irradiance,
                                           double tolerance) const {
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

/// What meets backs or leaves the scene.
OutsideFlux GatheredLight::light_astray() {
    if (!backs_open_)
        backs_open_.emplace(scene_, mesh_, overlaps_, rays_, energy_aim_.back_rays,
                            mix(seed_, 0x6261636b));
    OutsideFlux outside =
        measure_outside(scene_, mesh_, shown_->display, rays_, backs_open_->gathered(),
                        energy_aim_.outside_rays, mix(seed_, 0x6f757473));
    double emitted = 0.0;
    for (PatchIndex i = 0; i < mesh_.size(); ++i)
        emitted += mesh_.patches[i].area * luminance(listed_exitance_[i] + other_exitance_[i]);
    const BackFlux backs = backs_open_->flux(
        *shown_, places(), noise_of_backs * energy_aim_.noise * emitted, energy_aim_.back_rays);
    // Rays from backs may all miss a lamp that is small; those that start there do not.
    const bool agree =
        ((backs.flux - outside.on_gathered).abs() <= sure_to_differ * outside.error_on_gathered)
            .all() ||
        outside.on_gathered.isZero(0.0);
    outside.backs += agree ? backs.flux : outside.on_gathered;
    const Rgb variance = agree ? backs.variance : Rgb(outside.error_on_gathered.square());
    outside.standard_error = (outside.standard_error.square() + variance).sqrt();
    return outside;
}

void GatheredLight::balance(double tolerance) {
    Rgb unsure = Rgb::Zero();  // of what is missing [W]
    for (int times = 0;; ++times) {
        const SplitIrradiance means = patch_means(*shown_, mesh_.size());
        std::vector<Rgb> irradiance(mesh_.size());
        for (std::size_t i = 0; i < irradiance.size(); ++i)
            irradiance[i] = means.direct[i] + means.indirect[i];
        energy_ = measure_energy(scene_, mesh_, light_astray(), irradiance);
        if (energy_.standard_error > energy_aim_.noise &&
            energy_aim_.outside_rays < most_outside_rays) {
            const double times_more = std::pow(energy_.standard_error / energy_aim_.noise, 2);
            energy_aim_.outside_rays = static_cast<std::size_t>(
                std::min(times_more * static_cast<double>(energy_aim_.outside_rays),
                         static_cast<double>(most_outside_rays)));
            energy_ = measure_energy(scene_, mesh_, light_astray(), irradiance);
        }
        if (times == 0) {
            Rgb arriving = Rgb::Zero();
            for (std::size_t i = 0; i < irradiance.size(); ++i)
                arriving += mesh_.patches[i].area * irradiance[i];
            unsure = energy_.missing() *
                     (1.0 - trusted(energy_.missing(), energy_.standard_error * energy_.emitted,
                                    energy_aim_.likely * arriving));
        }
        const Rgb missing = energy_.missing() - unsure;
        // Rays outside are others each time: what is left of a correction may be their noise.
        const double matters = times == 0 ? energy_aim_.balanced
                                          : std::max(energy_aim_.balanced, energy_.standard_error);
        if (times == most_balances || (missing.abs() <= matters * energy_.emitted).all()) return;
        const std::vector<Rgb> extra = evened_out(missing, irradiance, tolerance);
        for (std::size_t i = 0; i < extra.size(); ++i) correction_.irradiance[i] += extra[i];
        shown_ = pass_.show(correction_.irradiance);
    }
}

}  // namespace patchlight
