#pragma once

#include "solver/display/light_sources.h"
#include "solver/scene/scene.h"
#include "tests/bench/shown_field.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// What a point reflects, found twice by chances of their own: their product with what is judged
/// holds no noise of either.
struct TruePoint {
    SurfaceIndex surface = 0;
    Vec3 position = Vec3::Zero();
    double reflectance = 0.0;
    std::array<double, 2> direct{}, indirect{};  // irradiance, luminance [W/m²]
    double rays = 0.0;                           // of each

    double reflected(std::size_t half) const {  // luminance of B - E [W/m²]
        return reflectance * (direct[half] + indirect[half]);
    }
    double noise() const { return 0.5 * (reflected(0) - reflected(1)); }  // of their mean
};

/// The light at points of a grey scene of parallelograms: direct light by samples of each lamp,
/// all other light by rays over the hemisphere that read a finer solution where they land. None of
/// it is gathered by what it judges.
class GatheredTruth {
  public:
    GatheredTruth(const Scene& scene, const RayScene& rays, const std::vector<LightSource>& lamps,
                  const ShownLattices& finer)
        : scene_(scene), rays_(rays), lamps_(lamps), finer_(finer) {}

    /// Points spread by area. Rays start from `first` of each half and go on where halves differ
    /// most, until noise is within `noise`, √mean(Y²) over √mean(Y²), or all have `most`.
    std::vector<TruePoint> at_points(std::size_t count, std::uint64_t seed, double first,
                                     double most, double noise) const;

  private:
    std::vector<TruePoint> spread(std::size_t count, std::uint64_t seed) const;
    void join(TruePoint& point, double rays, std::uint64_t seed) const;
    double direct(const TruePoint& point, std::uint64_t seed) const;
    double indirect(const TruePoint& point, double rays, std::uint64_t seed) const;

    const Scene& scene_;
    const RayScene& rays_;
    const std::vector<LightSource>& lamps_;
    const ShownLattices& finer_;
};

/// Root mean squares over points, as shares of that of what is reflected [1].
double true_error(const std::vector<TruePoint>& points, const std::vector<double>& judged);
double truth_noise(const std::vector<TruePoint>& points);

}  // namespace patchlight
