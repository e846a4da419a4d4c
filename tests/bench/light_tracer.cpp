#include "tests/bench/light_tracer.h"

#include "tests/bench/useful_light.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr std::size_t pairs = 16;        // batches of either half
constexpr double pilot = 0.1;            // of the landings, to decide on bins
constexpr double bins_of_dark = 1500.0;  // as many share the surfaces even where little lands
constexpr double least_absorbed = 0.1;   // of a scene as pale as any [1]
constexpr double first_launches = 65536.0;

double divided(double sum, double by) { return by > 0.0 ? sum / by : 0.0; }

Vec3 cosine_direction(const PlaneFrame& frame, Random& random) {
    const double radius = std::sqrt(random.unit());
    const double angle = 2.0 * std::numbers::pi * random.unit();
    return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v +
           std::sqrt(std::max(1e-12, 1.0 - radius * radius)) * frame.normal;
}

}  // namespace

/// Calls landed(surface, position, light, reflected light) at every landing of one launch. Bounces
/// that carry less than is usual go on by chance alone (Russian roulette).
template <typename Landing>
void LightTracer::follow(Random& random, const Landing& landed) const {
    const Launch launch = emission_.launch(random);
    Rgb light = launch.light;
    if (!(light > 0.0).any()) return;
    auto at = traced_.land(launch.surface, launch.position, launch.direction);
    while (at) {
        const Surface& surface = scene_.surfaces[at->surface];
        const Rgb reflected = light * scene_.materials[surface.material].reflectance;
        landed(*at, light, reflected);
        const double goes_on = usual_ > 0.0 ? reflected.maxCoeff() / usual_ : 0.0;
        if (!random.chance(goes_on)) return;
        light = reflected / std::min(1.0, goes_on);
        const Vec3 direction = cosine_direction(traced_.flat(at->surface).frame, random);
        at = traced_.land(at->surface, at->position, direction);
    }
}

LightTracer::LightTracer(const Scene& scene, const TracerSettings& settings)
    : scene_(scene), settings_(settings), traced_(scene), emission_(traced_) {
    learn_useful_light(traced_, emission_, settings.seed ^ 0x5eed, settings.searches);
    find_bins();
    if (emission_.is_dark()) return;
    batches_.resize(2 * pairs);
    tbb::parallel_for(std::size_t{0}, batches_.size(),
                      [&](std::size_t k) { batches_[k] = trace(100 + k); });
    for (const Batch& batch : batches_) landings_ += batch.landings;
}

void LightTracer::find_bins() {
    std::vector<Landed> landed;
    double reflecting = 0.0, sent_back = 0.0;
    for (const Surface& surface : scene_.surfaces)
        if (const Rgb& share = scene_.materials[surface.material].reflectance;
            (share > 0.0).any()) {
            reflecting += surface.area;
            sent_back += share.maxCoeff() * surface.area;
        }
    if (!emission_.is_dark()) {
        Random first(settings_.seed, 0);
        double usual = 0.0;
        for (double k = 0.0; k < first_launches; ++k)  // while usual_ is 0 nothing goes on
            follow(first, [&](const LandedAt&, const Rgb&, const Rgb& reflected) {
                usual += reflected.maxCoeff() / first_launches;
            });
        // Of the paler a scene is, the more of the light is in late bounces: followed further, they
        // tell its level without chance.
        usual_ = usual * std::max(least_absorbed, 1.0 - sent_back / reflecting);
        Random random(settings_.seed, 1);
        double launches = 0.0, landings = 0.0;
        const double wanted = pilot * settings_.landings;
        for (; landings < wanted && launches < wanted; ++launches)
            follow(random, [&](const LandedAt& at, const Rgb&, const Rgb& reflected) {
                landings += 1.0;
                if (const double flux = luminance(reflected); flux > 0.0)
                    landed.push_back(
                        {at.surface, traced_.flat(at.surface).frame.flat(at.position), flux});
            });
        particles_ = std::ceil(settings_.landings / static_cast<double>(2 * pairs) * launches /
                               std::max(landings, 0.1 * launches));
    }
    bins_ = std::make_unique<Bins>(traced_, landed,
                                   BinSizes{pilot * settings_.a_bin, reflecting / bins_of_dark});
}

LightTracer::Batch LightTracer::trace(std::uint64_t stream) const {
    Batch batch{std::vector<double>(bins_->size()),
                std::vector<Rgb>(scene_.surfaces.size(), Rgb::Zero())};
    Random random(settings_.seed, stream);
    for (double k = 0.0; k < particles_; ++k)
        follow(random, [&](const LandedAt& at, const Rgb& light, const Rgb& reflected) {
            batch.landings += 1.0;
            batch.arriving[at.surface] += light;
            batch.reflected[bins_->bin(at.surface,
                                       traced_.flat(at.surface).frame.flat(at.position))] +=
                luminance(reflected);
        });
    for (double& flux : batch.reflected) flux /= particles_;
    for (Rgb& flux : batch.arriving) flux /= particles_;
    return batch;
}

double LightTracer::reflected(std::size_t i) const {
    double sum = 0.0;
    for (const Batch& batch : batches_) sum += batch.reflected[i];
    return divided(sum, static_cast<double>(batches_.size()));
}

Rgb LightTracer::arriving(SurfaceIndex s) const {
    Rgb sum = Rgb::Zero();
    for (const Batch& batch : batches_) sum += batch.arriving[s];
    return batches_.empty() ? sum : Rgb(sum / static_cast<double>(batches_.size()));
}

Rgb LightTracer::arriving_error(std::span<const SurfaceIndex> surfaces) const {
    const auto n = static_cast<double>(batches_.size());
    Rgb sum = Rgb::Zero(), squares = Rgb::Zero();
    for (const Batch& batch : batches_) {
        Rgb flux = Rgb::Zero();
        for (const SurfaceIndex s : surfaces) flux += batch.arriving[s];
        sum += flux;
        squares += flux * flux;
    }
    if (n < 2.0) return sum;
    return ((squares - sum * sum / n).max(0.0) / (n * (n - 1.0))).sqrt();
}

/// The ratio of what is off to all, once from all batches and once without each pair of them:
/// how these differ tells the standard error (jackknife; Quenouille 1956, Tukey 1958).
TrueError LightTracer::error_of(std::span<const double> shown) const {
    if (batches_.empty()) return {};
    const std::size_t n = bins_->size();
    std::vector<double> half[2] = {std::vector<double>(n), std::vector<double>(n)};
    for (std::size_t k = 0; k < batches_.size(); ++k)
        for (std::size_t i = 0; i < n; ++i) half[k % 2][i] += batches_[k].reflected[i];
    const auto ratio = [&](std::ptrdiff_t without) {
        const double count = static_cast<double>(pairs) - (without < 0 ? 0.0 : 1.0);
        double off = 0.0, all = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            if (!(bins_->area(i) > 0.0)) continue;
            double a = half[0][i], b = half[1][i];
            if (without >= 0) {
                a -= batches_[static_cast<std::size_t>(2 * without)].reflected[i];
                b -= batches_[static_cast<std::size_t>(2 * without + 1)].reflected[i];
            }
            off += (shown[i] - a / count) * (shown[i] - b / count) / bins_->area(i);
            all += a / count * (b / count) / bins_->area(i);
        }
        return divided(off, all);
    };
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < pairs; ++k) {
        const double left = ratio(static_cast<std::ptrdiff_t>(k));
        sum += left;
        squares += left * left;
    }
    const auto m = static_cast<double>(pairs);
    const double sigma = std::sqrt(std::max(0.0, (squares - sum * sum / m) * (m - 1.0) / m));
    const double whole = ratio(-1);
    const auto root = [](double x) { return std::sqrt(std::max(0.0, x)); };
    return {root(whole), root(whole - sigma), root(whole + sigma)};
}

}  // namespace patchlight
