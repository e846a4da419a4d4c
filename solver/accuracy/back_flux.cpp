#include "solver/accuracy/back_flux.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t first_rays = 2 * ray_batch;  // from each back
constexpr std::size_t most_of_back = 16384;
constexpr double inward = 1e-4;  // of the way to a triangle's centre, off the edges of others

/// A mean of n numbers, and how they spread.
struct Tally {
    Rgb sum = Rgb::Zero(), square = Rgb::Zero();
    std::size_t n = 0;
    void add(const Tally& other) {
        sum += other.sum;
        square += other.square;
        n += other.n;
    }
    Rgb mean() const { return sum / static_cast<double>(n); }
    Rgb variance() const {  // of one
        return (square / static_cast<double>(n) - mean() * mean()).max(0.0);
    }
};

struct Backs {
    const Scene& scene;
    const PatchMesh& mesh;
    const RayScene& rays;
    const TreeDisplay& shown;
    const ShownPlaces& places;
    std::uint64_t seed;
    std::vector<std::vector<std::uint32_t>> triangles;  // of the display, per surface
    std::vector<std::vector<double>> areas;             // cumulated, of those [m²]

    void sort_triangles() {
        triangles.resize(scene.surfaces.size());
        areas.resize(scene.surfaces.size());
        const DisplayMesh& display = shown.display;
        for (std::uint32_t t = 0; t < display.triangles.size(); ++t) {
            const SurfaceIndex s = mesh.patches[display.patch[t]].surface;
            const auto& [a, b, c] = display.triangles[t];
            const auto& p = display.positions;
            triangles[s].push_back(t);
            areas[s].push_back((areas[s].empty() ? 0.0 : areas[s].back()) +
                               0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm());
        }
    }
    double area(SurfaceIndex s) const { return areas[s].empty() ? 0.0 : areas[s].back(); }

    /// Radiosity that ray number n from the back of s lands on, for sixteen of them [W/m²].
    Tally look(SurfaceIndex s, std::size_t first, std::uint64_t stream) const {
        RayBatch batch;
        LandingBatch landings;
        const RayPoint out = -scene.surfaces[s].normal.cast<float>();
        const RayFrame frame = frame_about(out);
        for (std::size_t k = 0; k < ray_batch; ++k) {
            const std::uint64_t key = mix(mix(seed, stream + s), first + k);
            const auto number = [&](std::uint64_t d) { return unit(mix(key, d)); };
            const auto found =
                std::upper_bound(areas[s].begin(), areas[s].end(), number(0) * area(s));
            const std::size_t at =
                std::min(static_cast<std::size_t>(found - areas[s].begin()), areas[s].size() - 1);
            const auto& corners = shown.display.triangles[triangles[s][at]];
            const double root = std::sqrt(number(1)), v = number(2);
            const std::array<double, 3> weight{1.0 - root, root * (1.0 - v), root * v};
            Vec3 position = Vec3::Zero();
            for (std::size_t c = 0; c < 3; ++c)
                position += ((1.0 - inward) * weight[c] + inward / 3.0) *
                            shown.display.positions[corners[c]];
            const RayPoint origin = rays.to_ray_space(position, rays.frame(s)) + rays.lift(s) * out;
            const RayPoint way = cosine_direction(frame, static_cast<float>(number(3)),
                                                  static_cast<float>(number(4)));
            batch.ox[k] = origin.x(), batch.dx[k] = way.x();
            batch.oy[k] = origin.y(), batch.dy[k] = way.y();
            batch.oz[k] = origin.z(), batch.dz[k] = way.z();
            batch.frame[k] = rays.frame(s);
        }
        rays.land(batch, ray_batch, landings);
        Tally tally;
        tally.n = ray_batch;
        for (std::size_t k = 0; k < ray_batch; ++k) {
            if (landings.landing[k] != Landing::front) continue;
            const auto place = places.find(landings.surface[k],
                                           RayPoint(landings.x[k], landings.y[k], landings.z[k]));
            if (!place) continue;
            Rgb radiosity = Rgb::Zero();
            for (std::size_t c = 0; c < 3; ++c)
                radiosity += place->weight[c] *
                             shown.display.radiosity[shown.display.triangles[place->triangle][c]];
            tally.sum += radiosity;
            tally.square += radiosity.square();
        }
        return tally;
    }

    /// So many rays from the back of each surface, whole batches.
    std::vector<Tally> look(const std::vector<std::size_t>& counts, std::uint64_t stream) const {
        std::vector<Tally> tallies(counts.size());
        tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t s) {
            for (std::size_t first = 0; first < counts[s]; first += ray_batch)
                tallies[s].add(look(static_cast<SurfaceIndex>(s), first, stream));
        });
        return tallies;
    }
};

}  // namespace

BackFlux gather_at_backs(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                         const TreeDisplay& shown, const ShownPlaces& places, std::size_t count,
                         std::uint64_t seed) {
    const std::size_t n = scene.surfaces.size();
    BackFlux found;
    found.gathered.assign(n, false);
    if (n * first_rays > count) return found;
    Backs backs{scene, mesh, rays, shown, places, seed, {}, {}};
    backs.sort_triangles();
    std::vector<std::size_t> counts(n, 0);
    for (SurfaceIndex s = 0; s < n; ++s)
        if (!scene.materials[scene.surfaces[s].material].two_sided && backs.area(s) > 0.0)
            counts[s] = first_rays;
    const std::vector<Tally> first = backs.look(counts, 0);
    // Least noise for all rays: in proportion to area times spread.
    std::vector<double> spread(n, 0.0);
    double whole = 0.0;
    for (SurfaceIndex s = 0; s < n; ++s) {
        counts[s] = 0;
        if (first[s].n == 0 || !(first[s].sum > 0.0).any()) continue;
        found.gathered[s] = true;
        whole += spread[s] = backs.area(s) * std::sqrt(luminance(first[s].variance()));
    }
    for (SurfaceIndex s = 0; s < n; ++s) {
        if (!found.gathered[s]) continue;
        const double share = whole > 0.0 ? spread[s] / whole : 0.0;
        const auto wanted = static_cast<std::size_t>(share * static_cast<double>(count));
        counts[s] =
            (std::clamp(wanted, first_rays, most_of_back) + ray_batch - 1) / ray_batch * ray_batch;
    }
    const std::vector<Tally> second = backs.look(counts, n);
    for (SurfaceIndex s = 0; s < n; ++s) {
        if (!found.gathered[s]) continue;
        found.flux += backs.area(s) * second[s].mean();
        found.variance +=
            std::pow(backs.area(s), 2) * second[s].variance() / static_cast<double>(second[s].n);
    }
    return found;
}

}  // namespace patchlight
