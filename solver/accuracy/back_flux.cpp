#include "solver/accuracy/back_flux.h"

#include "solver/mesh/make_patches.h"
#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::size_t first_rays = 2 * ray_batch;  // from each back
constexpr double inward = 1e-4;  // of the way to a triangle's centre, off the edges of others

}  // namespace

/// Of radiosities that rays land on.
struct BackGather::Tally {
    Rgb sum = Rgb::Zero(), square = Rgb::Zero();
    std::size_t n = 0, fronts = 0;
    void add(const Tally& other) {
        sum += other.sum;
        square += other.square;
        n += other.n;
        fronts += other.fronts;
    }
    Rgb mean() const { return sum / static_cast<double>(n); }
    Rgb variance() const {  // of one
        return (square / static_cast<double>(n) - mean() * mean()).max(0.0);
    }
};

BackGather::BackGather(const Scene& scene, const PatchMesh& mesh, const CoplanarOverlaps& overlaps,
                       const RayScene& rays, std::size_t count, std::uint64_t seed)
    : scene_(scene),
      mesh_(mesh),
      rays_(rays),
      seed_(seed),
      gathered_(scene.surfaces.size(), false) {
    const std::size_t n = scene.surfaces.size();
    if (n * first_rays > count) return;
    std::vector<Back> backs(n);
    std::vector<std::size_t> fronts(n, 0);
    tbb::parallel_for(SurfaceIndex{0}, static_cast<SurfaceIndex>(n), [&](SurfaceIndex s) {
        if (overlaps.any(s)) return;
        backs[s] = back_of(s);
        for (std::size_t first = 0; backs[s].area() > 0.0 && first < first_rays; first += ray_batch)
            fronts[s] += look(backs[s], first, nullptr, nullptr).fronts;
    });
    for (SurfaceIndex s = 0; s < n; ++s) {
        gathered_[s] = fronts[s] > 0;
        if (gathered_[s]) backs_.push_back(std::move(backs[s]));
    }
}

/// What is not covered of it.
BackGather::Back BackGather::back_of(SurfaceIndex s) const {
    Back back;
    back.surface = s;
    for (PatchIndex i = mesh_.first_of_surface[s]; i < mesh_.first_of_surface[s + 1]; ++i) {
        const Patch& patch = mesh_.patches[i];
        if (patch.covered) continue;
        for (std::size_t k = 2; k < patch.corner_count(); ++k) {
            const std::array<VertexIndex, 3> t{patch.vertices[0], patch.vertices[k - 1],
                                               patch.vertices[k]};
            const auto& p = mesh_.vertices;
            back.areas.push_back(back.area() +
                                 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm());
            back.triangles.push_back(t);
        }
    }
    return back;
}

/// Sixteen rays, from number `first` on. Without a display: where they land alone.
BackGather::Tally BackGather::look(const Back& back, std::size_t first, const TreeDisplay* shown,
                                   const ShownPlaces* places) const {
    RayBatch batch;
    LandingBatch landings;
    const SurfaceIndex s = back.surface;
    const RayPoint out = -scene_.surfaces[s].normal.cast<float>();
    const RayFrame frame = frame_about(out);
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const std::uint64_t key = mix(mix(seed_, shown ? s : ~std::uint64_t{s}), first + k);
        const auto number = [&](std::uint64_t d) { return unit(mix(key, d)); };
        const auto found =
            std::upper_bound(back.areas.begin(), back.areas.end(), number(0) * back.area());
        const auto& corners = back.triangles[std::min(
            static_cast<std::size_t>(found - back.areas.begin()), back.areas.size() - 1)];
        const double root = std::sqrt(number(1)), v = number(2);
        const std::array<double, 3> weight{1.0 - root, root * (1.0 - v), root * v};
        Vec3 position = Vec3::Zero();
        for (std::size_t c = 0; c < 3; ++c)
            position += ((1.0 - inward) * weight[c] + inward / 3.0) * mesh_.vertices[corners[c]];
        const RayPoint origin = rays_.to_ray_space(position, rays_.frame(s)) + rays_.lift(s) * out;
        const RayPoint way =
            cosine_direction(frame, static_cast<float>(number(3)), static_cast<float>(number(4)));
        batch.ox[k] = origin.x(), batch.dx[k] = way.x();
        batch.oy[k] = origin.y(), batch.dy[k] = way.y();
        batch.oz[k] = origin.z(), batch.dz[k] = way.z();
        batch.frame[k] = rays_.frame(s);
    }
    rays_.land(batch, ray_batch, landings);
    Tally tally;
    tally.n = ray_batch;
    for (std::size_t k = 0; k < ray_batch; ++k) {
        if (landings.landing[k] != Landing::front) continue;
        ++tally.fronts;
        if (!shown) continue;
        const auto place = places->find(landings.surface[k],
                                        RayPoint(landings.x[k], landings.y[k], landings.z[k]));
        if (!place) continue;
        Rgb radiosity = Rgb::Zero();
        for (std::size_t c = 0; c < 3; ++c)
            radiosity += place->weight[c] *
                         shown->display.radiosity[shown->display.triangles[place->triangle][c]];
        tally.sum += radiosity;
        tally.square += radiosity.square();
    }
    return tally;
}

/// Least noise for all rays: so many to a back as its area times how much they differ.
BackFlux BackGather::flux(const TreeDisplay& shown, const ShownPlaces& places, double noise,
                          std::size_t count) const {
    std::vector<Tally> tallies(backs_.size());
    const auto take = [&](const std::vector<std::size_t>& first,
                          const std::vector<std::size_t>& end) {
        tbb::parallel_for(std::size_t{0}, backs_.size(), [&](std::size_t b) {
            for (std::size_t k = first[b]; k < end[b]; k += ray_batch)
                tallies[b].add(look(backs_[b], k, &shown, &places));
        });
    };
    std::vector<std::size_t> none(backs_.size(), 0), some(backs_.size(), first_rays), all = some;
    take(none, some);
    std::vector<double> spread;
    for (std::size_t b = 0; b < backs_.size(); ++b)
        spread.push_back(backs_[b].area() * std::sqrt(luminance(tallies[b].variance())));
    const double whole = std::accumulate(spread.begin(), spread.end(), 0.0),
                 wanted = std::min(std::pow(whole / std::max(noise, 1e-300), 2),
                                   static_cast<double>(count));
    for (std::size_t b = 0; b < backs_.size() && whole > 0.0; ++b) {
        const double batches = std::ceil(spread[b] / whole * wanted / ray_batch);
        all[b] = std::max(first_rays, ray_batch * static_cast<std::size_t>(batches));
    }
    take(some, all);
    BackFlux found;
    for (std::size_t b = 0; b < backs_.size(); ++b) {
        const double area = backs_[b].area();
        found.flux += area * tallies[b].mean();
        found.variance += area * area * tallies[b].variance() / static_cast<double>(tallies[b].n);
    }
    return found;
}

}  // namespace patchlight
