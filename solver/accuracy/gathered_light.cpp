#include "solver/accuracy/gathered_light.h"

#include "solver/accuracy/aperture_light.h"
#include "solver/display/patch_slopes.h"
#include "solver/transport/patch_fields.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace patchlight {

namespace {
constexpr double rounding = 1e-12;     // of what is given off, hardly a reflection [1]
constexpr double left_of_bends = 0.3;  // that triangles miss, beside what gathering may miss [1]
/// Of direct light, where something shades: at first, and over the root of its aim.
constexpr double first_elements = 4000.0, root_elements = 400.0, most_elements = 8000.0;
constexpr double noise_decay = 0.75;  // of a penumbra, with the number of samples of a lamp
constexpr int most_samples = 8192;
constexpr double bright_lamp = 16.0;  // times the mean: a lamp that must not be missed in part
/// A first look at rooms lit through gaps, and of what it sees how much is sure to be there [1].
constexpr DirectEffort glance{16, 64};
constexpr double part_of_glance = 0.25;
constexpr double correction_tolerance = 0.1;  // of a correction that is itself small [1]
}  // namespace

GatheredLight::GatheredLight(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                             const MeshLines& lines, std::uint64_t seed, StopTokens stops)
    : scene_(scene),
      mesh_(mesh),
      rays_(rays),
      overlaps_(lines.overlaps),
      seed_(seed),
      pass_(scene, mesh, rays, lines, seed, std::move(stops)),
      locator_(scene, mesh, rays),
      irradiance_(mesh.size(), Rgb::Zero()) {
    sort_exitance();
}

/// Of emitters too many to be gathered from one by one, rays read the light.
void GatheredLight::sort_exitance() {
    std::vector<bool> listed(scene_.surfaces.size(), false);
    for (const LightSource& source : pass_.points().gather().sources())
        listed[source.surface] = true;
    listed_exitance_ = exitances(scene_, mesh_);
    other_exitance_.assign(mesh_.size(), Rgb::Zero());
    for (PatchIndex i = 0; i < mesh_.size(); ++i)
        if (!listed[mesh_.patches[i].surface]) std::swap(listed_exitance_[i], other_exitance_[i]);
}

bool GatheredLight::start(const CoarseTransport& transport, const std::vector<double>& backs,
                          const EnergyAim& energy, DirectEffort& effort, double noise,
                          double tolerance, const CoarseTransport::Observe& observe) {
    constexpr double whatever_is_missed = 1e300;
    backs_ = backs;
    transport_ = &transport;
    energy_aim_ = energy;
    coarse_.emplace(scene_, mesh_, transport, other_exitance_);
    if (transport.is_exact())
        exact_direct_ = to_rgb(*transport.once(coarse_->to_field(listed_exitance_)));
    effort.alike = noise;
    const auto lit_by = [&](const DirectEffort& of) {
        return of.by_apertures ? lit_by_apertures(mesh_, pass_.points(), of.enough) : 1.0;
    };
    const auto solve_once = [&] {
        return pass_.refine_direct({whatever_is_missed, first_elements}, effort) &&
               solve_coarse(tolerance, observe);
    };
    bool is_whole = true;
    effort.by_apertures = has_gaps() && apertures_matter(scene_, mesh_, pass_.points(), effort,
                                                         noise, mix(seed_, 0x61706572));
    if (effort.by_apertures) {
        is_whole = pass_.refine_direct({whatever_is_missed, 1.0}, glance);
        direct_means_ = means_of(pass_.show({})).direct;
        effort.enough = part_of_glance * noise * mean_irradiance();
        effort.lit_by_apertures = lit_by(effort);
        pass_.restart_direct();
    }
    is_whole = is_whole && solve_once();
    if (is_whole) {
        effort.bright = bright_lamp * mean_irradiance();
        // Where a small spot holds most of the light, less than its share of the norm is enough.
        double area = 0.0;
        for (const Patch& patch : mesh_.patches) area += patch.covered ? 0.0 : patch.area;
        effort.enough = noise * std::max(mean_irradiance(), norm() / std::sqrt(area));
        effort.lit_by_apertures = lit_by(effort);
    }
    const double too_much = is_whole ? pass_.direct_noise() / (noise * norm()) : 0.0;
    if (too_much > 1.0 && effort.most < most_samples) {
        effort.most = static_cast<int>(
            std::min(effort.most * std::pow(too_much, 1.0 / noise_decay), double{most_samples}));
        pass_.restart_direct();
        is_whole = solve_once();
    }
    if (!is_whole) show_what_there_is(tolerance, observe);
    return is_whole;
}

bool GatheredLight::solve_coarse(double tolerance, const CoarseTransport::Observe& observe) {
    const auto began = std::chrono::steady_clock::now();
    direct_means_ = means_of(pass_.show({})).direct;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    seconds_per_vertex_ = took.count() / static_cast<double>(pass_.tree().vertices().size());
    return coarse_->solve(direct_means_, tolerance, observe);
}

/// Light that rounding may have made of what is given off [W/m].
double GatheredLight::hardly_any() const {
    double sum = 0.0;
    for (PatchIndex i = 0; i < mesh_.size(); ++i) {
        const double y = luminance(listed_exitance_[i] + other_exitance_[i]);
        sum += mesh_.patches[i].area * y * y;
    }
    return rounding * std::sqrt(sum);
}

double GatheredLight::norm() const {
    if (reflects()) return std::max(coarse_->norm(), shown_norm_);
    double sum = 0.0;
    for (PatchIndex i = 0; i < mesh_.size(); ++i) {
        const double y = DisplayPass::least_weight * luminance(direct_means_[i]);
        sum += mesh_.patches[i].area * y * y;
    }
    return std::max(std::sqrt(sum), DisplayPass::least_weight * hardly_any());
}

double GatheredLight::mean_irradiance() const {
    double sum = 0.0, area = 0.0;
    for (PatchIndex i = 0; i < mesh_.size(); ++i) {
        const double a = mesh_.patches[i].covered ? 0.0 : mesh_.patches[i].area;
        sum += a * luminance(direct_means_[i]);
        if (!coarse_->irradiance().empty()) sum += a * luminance(coarse_->irradiance()[i]);
        area += a;
    }
    return area > 0.0 ? sum / area : 0.0;
}

/// Means over patches: direct light of those that nothing can shade from the matrix, where it is
/// exact.
SplitIrradiance GatheredLight::means_of(const TreeDisplay& shown) const {
    SplitIrradiance means = patch_means(shown, mesh_.size());
    if (exact_direct_.empty()) return means;
    for (PatchIndex i = 0; i < mesh_.size(); ++i)
        if (!pass_.points().may_be_shaded(i)) means.direct[i] = exact_direct_[i];
    return means;
}

/// What is displayed, without the sources that are gathered from one by one.
FieldTable GatheredLight::table_of(const TreeDisplay& shown) const {
    return {mesh_, shown.display, rays_, shown.display.radiosity, listed_exitance_};
}

std::shared_ptr<const ReflectedField> GatheredLight::make_field(FieldTable table) const {
    return std::make_shared<const ReflectedField>(scene_, mesh_, rays_, locator_, std::move(table));
}

/// What rays of the next round read: what is displayed, with direct light as it is known by now.
void GatheredLight::read_newest() {
    read_ = field_;
    read_means_ = field_means_;
    if (!shown_ || pass_.direct().gathered() == direct_shown_) return;
    const TreeDisplay newest = pass_.show(correction_.irradiance);
    const SplitIrradiance arriving = means_of(newest);
    read_ = make_field(table_of(newest));
    for (std::size_t i = 0; i < read_means_.size(); ++i)
        read_means_[i] = other_exitance_[i] +
                         coarse_->reflectance()[i] * (arriving.direct[i] + arriving.indirect[i]);
}

/// Rays read direct light as finely as it is known, and the rest from the coarse solution.
void GatheredLight::read_coarse() {
    const TreeDisplay shown = pass_.show({});
    const std::vector<Rgb> direct = patch_means(shown, mesh_.size()).direct;
    field_means_ = coarse_->reflected();
    std::vector<Rgb> rest = field_means_;
    for (std::size_t i = 0; i < rest.size(); ++i)
        rest[i] -= other_exitance_[i] + coarse_->reflectance()[i] * direct[i];
    FieldTable table = table_of(shown);
    add_sloped(scene_, mesh_, rest, backs_, table);
    field_ = make_field(std::move(table));
}

const GatherNoise& GatheredLight::noise() {
    if (!field_) read_coarse();
    if (!noise_)
        noise_.emplace(scene_, mesh_, pass_.points(), *field_, field_means_,
                       mix(seed_, 0x6e6f6973));
    return *noise_;
}

bool GatheredLight::gather(const GatherAim& aim, double tolerance,
                           const CoarseTransport::Observe& observe) {
    const DisplayPass::Aim direct{aim.direct * norm(),
                                  std::min(most_elements, root_elements / std::sqrt(aim.direct))},
        indirect{aim.indirect * norm(), 1.0 / aim.indirect};
    if (aim.direct_anew && shown_) pass_.restart_direct();
    // Shooting once more takes too long.
    const bool first = !shown_, by_matrix = first && !exact_direct_.empty();
    if (!pass_.refine_direct(direct, aim.effort) ||
        (by_matrix && !solve_coarse(tolerance, observe))) {
        show_what_there_is(tolerance, observe);
        return false;
    }
    if (first) read_coarse();
    if (aim.gathered == GatherAim::Indirect::anew) {
        read_newest();
        read_coarsely_ = first;
        pass_.restart_indirect();
    }
    if (aim.gathered != GatherAim::Indirect::kept &&
        !pass_.refine_indirect(indirect, *read_, aim.rays)) {
        if (!shown_) {
            pass_.restart_indirect();
            show_what_there_is(tolerance, observe);
        }
        return false;
    }
    pass_.show_bends(left_of_bends * std::hypot(aim.direct, aim.indirect) * norm());
    const SplitIrradiance gathered = means_of(pass_.show({}));
    std::vector<Rgb> change = other_exitance_;
    for (std::size_t i = 0; i < change.size(); ++i)
        change[i] += coarse_->reflectance()[i] * (gathered.direct[i] + gathered.indirect[i]) -
                     read_means_[i];
    correction_ = coarse_->correct(change, correction_tolerance);
    shown_ = pass_.show(correction_.irradiance);
    balance(tolerance);
    show(gathered);
    return true;
}

/// What rays read from now on is what is shown.
void GatheredLight::show(const SplitIrradiance& gathered) {
    field_ = make_field(table_of(*shown_));
    direct_shown_ = pass_.direct().gathered();
    direct_means_ = gathered.direct;
    double square = 0.0;
    for (const double norm : displayed_norms(scene_, mesh_, *shown_)) square += norm * norm;
    shown_norm_ = std::sqrt(square);
    const SplitIrradiance corrected = patch_means(*shown_, mesh_.size());
    for (std::size_t i = 0; i < irradiance_.size(); ++i) {
        irradiance_[i] = direct_means_[i] + corrected.indirect[i];
        field_means_[i] = other_exitance_[i] + coarse_->reflectance()[i] * irradiance_[i];
    }
}

/// Direct light as far as it was gathered, and the rest as the coarse solution has it.
void GatheredLight::show_what_there_is(double tolerance, const CoarseTransport::Observe& observe) {
    if (shown_) return;
    if (pass_.direct().lacks_roots())
        if (const auto guess = transport_->once(coarse_->to_field(listed_exitance_)))
            pass_.guess_direct(to_rgb(*guess));
    const SplitIrradiance gathered = means_of(pass_.show({}));
    coarse_->solve(gathered.direct, tolerance, observe);
    field_means_ = coarse_->reflected();
    correction_.irradiance = coarse_->irradiance();
    shown_ = pass_.show(correction_.irradiance);
    balance(tolerance);
    show(gathered);
}

CheckReport GatheredLight::check(const CheckEffort& effort, std::uint64_t seed) const {
    return check_display(scene_, *shown_, pass_.points(), *field_, effort, seed);
}

ReflectedLight GatheredLight::reflected() const {
    std::vector<Rgb> reflected = field_means_;
    for (std::size_t i = 0; i < reflected.size(); ++i) reflected[i] -= other_exitance_[i];
    ReflectedLight light = measure_reflected(scene_, mesh_, reflected, direct_means_);
    const std::vector<double> displayed = displayed_norms(scene_, mesh_, *shown_);
    double square = 0.0;
    for (std::size_t o = 0; o < displayed.size(); ++o) {
        light.norm_of_object[o] = std::max(light.norm_of_object[o], displayed[o]);
        square += light.norm_of_object[o] * light.norm_of_object[o];
    }
    light.norm = std::sqrt(square);
    return light;
}

}  // namespace patchlight
