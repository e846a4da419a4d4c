#pragma once

#include "tests/bench/bins.h"
#include "tests/bench/emission.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace patchlight {

struct TracerSettings {
    double landings = 2e7;  // of light on fronts, in all; 4 times as many: half the noise
    double a_bin = 500.0;   // landings of a bin; fewer: finer bins, more noise in each
    std::size_t searches =
        6'400'000;  // for gaps and spots, a round: fewer miss beams of a few centimetres
    std::uint64_t seed = 1;
};

/// An error and how sure it is.
struct TrueError {
    double value = 0.0;            // √∫ (B̃ − B)² over √∫ (B − E)², of bin means [1]
    double low = 0.0, high = 0.0;  // one standard error below and above [1]
    double sigma() const { return 0.5 * (high - low); }
};

/// The light of a scene by particles that start at lamps and carry their own bounces, in two
/// halves that share no chance: products of the two, or of what differs from them, hold no noise of
/// either in the mean.
class LightTracer {
  public:
    LightTracer(const Scene& scene, const TracerSettings& settings);

    const TracedScene& traced() const { return traced_; }
    const Bins& bins() const { return *bins_; }
    /// Reflected luminance of bin i, mean of all [W].
    double reflected(std::size_t i) const;
    /// Arriving at surface s, mean of all [W].
    Rgb arriving(SurfaceIndex s) const;
    /// Standard error of what arrives at surfaces in all [W].
    Rgb arriving_error(std::span<const SurfaceIndex> surfaces) const;
    double landings() const { return landings_; }

    /// How far off a field is whose reflected luminance in each bin is given [W].
    TrueError error_of(std::span<const double> shown) const;

  private:
    struct Batch {
        std::vector<double> reflected;  // in each bin, luminance [W]
        std::vector<Rgb> arriving;      // at each surface [W]
        double landings = 0.0;
    };
    void find_bins();
    Batch trace(std::uint64_t stream) const;
    template <typename Landing>
    void follow(Random& random, const Landing& landed) const;

    const Scene& scene_;
    TracerSettings settings_;
    TracedScene traced_;
    Emission emission_;
    double usual_ = 0.0;      // light that goes on without chance, about what a launch reflects [W]
    double particles_ = 0.0;  // of a batch
    std::unique_ptr<Bins> bins_;
    std::vector<Batch> batches_;  // halves of every batch follow one another
    double landings_ = 0.0;
};

}  // namespace patchlight
