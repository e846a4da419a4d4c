#include "solver/accuracy/outside_flux.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace patchlight {

namespace {

constexpr std::size_t rays_at_a_time = 1024;  // whole batches
constexpr double inward = 1e-4;  // of the way to a triangle's centre, off the edges of others
constexpr double unseen = 1.5;   // over n: half of what n of n leave in doubt, to 95 %

struct Start {
    RayPoint origin, normal;
    FrameIndex frame = 0;
    Rgb power = Rgb::Zero();  // that the ray carries, times the number of rays [W]
};

/// Points of a display in proportion to its luminance.
class BrightPoints {
  public:
    BrightPoints(const Scene& scene, const PatchMesh& mesh, const DisplayMesh& display,
                 const RayScene& rays)
        : scene_(scene), mesh_(mesh), display_(display), rays_(rays) {
        cumulative_.reserve(display.triangles.size());
        for (const auto& [a, b, c] : display.triangles) {
            const auto& p = display.positions;
            const double area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
            total_ +=
                area *
                luminance(display.radiosity[a] + display.radiosity[b] + display.radiosity[c]) / 3.0;
            cumulative_.push_back(total_);
        }
    }
    double total() const { return total_; }  // [W]

    /// `share` of the cumulated power picks the triangle, u and v in [0, 1) its point.
    Start at(double share, double u, double v) const {
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), share * total_);
        const std::size_t t =
            std::min(static_cast<std::size_t>(found - cumulative_.begin()), cumulative_.size() - 1);
        const auto& corners = display_.triangles[t];
        const double root = std::sqrt(u);
        const std::array<double, 3> weight{1.0 - root, root * (1.0 - v), root * v};
        Vec3 position = Vec3::Zero(), centre = Vec3::Zero();
        Rgb radiosity = Rgb::Zero(), mean = Rgb::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            position += weight[c] * display_.positions[corners[c]];
            centre += display_.positions[corners[c]] / 3.0;
            radiosity += weight[c] * display_.radiosity[corners[c]];
            mean += display_.radiosity[corners[c]] / 3.0;
        }
        const SurfaceIndex s = mesh_.patches[display_.patch[t]].surface;
        Start start;
        start.normal = scene_.surfaces[s].normal.cast<float>();
        start.frame = rays_.frame(s);
        start.origin = rays_.to_ray_space(position + inward * (centre - position), start.frame) +
                       rays_.lift(s) * start.normal;
        start.power = radiosity * (total_ / luminance(mean));
        return start;
    }

  private:
    const Scene& scene_;
    const PatchMesh& mesh_;
    const DisplayMesh& display_;
    const RayScene& rays_;
    std::vector<double> cumulative_;  // of area times luminance, by triangle [W]
    double total_ = 0.0;
};

struct Tally {
    Rgb backs = Rgb::Zero(), escaped = Rgb::Zero(), square = Rgb::Zero();
    Rgb gathered = Rgb::Zero(), gathered_square = Rgb::Zero();
};

struct Counter {
    const BrightPoints& bright;
    const RayScene& rays;
    const SobolPoints& points;
    const std::vector<bool>& gathered;
    std::array<std::uint32_t, 4> seeds;

    /// Of rays [first, end), whole batches.
    Tally count(std::size_t first, std::size_t end) const {
        Tally tally;
        RayBatch batch;
        LandingBatch landings;
        std::array<Rgb, ray_batch> power;
        for (; first < end; first += ray_batch) {
            for (std::size_t k = 0; k < ray_batch; ++k) {
                const std::size_t n = first + k;
                const auto number = [&](std::size_t d) { return points.at(d, n, seeds[d]); };
                const double share =
                    (static_cast<double>(n) + 0.5) / static_cast<double>(points.size());
                const Start start = bright.at(share, static_cast<double>(number(0)),
                                              static_cast<double>(number(1)));
                const RayPoint direction =
                    cosine_direction(frame_about(start.normal), number(2), number(3));
                batch.ox[k] = start.origin.x(), batch.dx[k] = direction.x();
                batch.oy[k] = start.origin.y(), batch.dy[k] = direction.y();
                batch.oz[k] = start.origin.z(), batch.dz[k] = direction.z();
                batch.frame[k] = start.frame;
                power[k] = start.power;
            }
            rays.land(batch, ray_batch, landings);
            for (std::size_t k = 0; k < ray_batch; ++k) {
                if (landings.landing[k] == Landing::front) continue;
                if (landings.landing[k] == Landing::back && gathered[landings.surface[k]]) {
                    tally.gathered += power[k];
                    tally.gathered_square += power[k] * power[k];
                    continue;
                }
                (landings.landing[k] == Landing::back ? tally.backs : tally.escaped) += power[k];
                tally.square += power[k] * power[k];
            }
        }
        return tally;
    }
};

}  // namespace

OutsideFlux measure_outside(const Scene& scene, const PatchMesh& mesh, const DisplayMesh& display,
                            const RayScene& rays, const std::vector<bool>& gathered,
                            std::size_t count, std::uint64_t seed) {
    OutsideFlux flux;
    const BrightPoints bright(scene, mesh, display, rays);
    if (!(bright.total() > 0.0)) return flux;
    const std::size_t chunks = (count + rays_at_a_time - 1) / rays_at_a_time;
    const SobolPoints points(chunks * rays_at_a_time);
    Counter counter{bright, rays, points, gathered, {}};
    for (std::uint64_t d = 0; d < counter.seeds.size(); ++d)
        counter.seeds[d] = static_cast<std::uint32_t>(mix(seed, d));
    std::vector<Tally> tallies(chunks);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        tallies[chunk] = counter.count(chunk * rays_at_a_time, (chunk + 1) * rays_at_a_time);
    });
    const double n = static_cast<double>(points.size());
    Rgb square = Rgb::Zero(), gathered_square = Rgb::Zero();
    for (const Tally& tally : tallies) {
        flux.backs += tally.backs / n;
        flux.escaped += tally.escaped / n;
        square += tally.square / n;
        flux.on_gathered += tally.gathered / n;
        gathered_square += tally.gathered_square / n;
    }
    flux.error_on_gathered = ((gathered_square - flux.on_gathered.square()).max(0.0) / n).sqrt();
    const Rgb astray = flux.backs + flux.escaped;
    flux.standard_error = ((square - astray * astray).max(0.0) / n).sqrt();
    // Where all go astray but a few that none of them met, they are alike by chance.
    for (Eigen::Index c = 0; c < 3; ++c)
        if (astray[c] > 0.0)
            flux.standard_error[c] = std::max(flux.standard_error[c], unseen * astray[c] / n);
    return flux;
}

}  // namespace patchlight
