#pragma once

#include "solver/display/aperture_set.h"
#include "solver/display/light_sources.h"
#include "solver/display/reflected_field.h"
#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/ray_scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace patchlight {

/// A place where irradiance is gathered.
struct GatherPoint {
    Vec3 position = Vec3::Zero();              // [m]
    Vec3 normal = Vec3::UnitZ();               // unit
    RayPoint origin;                           // where its rays start, above what it touches
    FrameIndex frame = 0;                      // of `origin`
    const std::vector<bool>* clear = nullptr;  // per source: nothing can stand between; or unknown
};

struct DirectEffort {
    int first = 16;  // samples of each source; all alike: no more
    int most = 256;  // where they disagree
    /// A source that would give more than this is sampled more at first, in proportion: n samples
    /// that see nothing of it leave a doubt of about 3/n, of a sun too much [W/m²].
    double bright = std::numeric_limits<double>::infinity();
    /// Noise at a point that is of no matter: samples that leave no more need none beside them, and
    /// apertures through which no more can come are left out [W/m²].
    double enough = 0.0;
    double alike = 0.02;  // the same, of what comes from one source or aperture [1]
    /// Share of the scene's area that apertures may light: noise is of matter there alone, so that
    /// there may be more, for the same norm.
    double lit_by_apertures = 1.0;
    /// Light through apertures is gathered by samples of those; else samples of lamps find it.
    bool by_apertures = true;
    /// First samples of a source that would give `whole` [W/m²].
    int first_of(double whole) const;
};

/// Irradiance at points: sources one by one, by Lambert's formula times the visibility that samples
/// weighted with the kernel measure; their light through apertures by samples of those; all other
/// light by rays over the hemisphere.
class PointGather {
  public:
    PointGather(const RayScene& rays, std::vector<LightSource> sources, int most_samples,
                const std::vector<Aperture>& apertures = {});

    const std::vector<LightSource>& sources() const { return sources_; }
    /// Those that are sampled, and all gaps that are known.
    const ApertureSet& apertures() const { return apertures_; }
    const ApertureSet& gaps() const { return gaps_; }
    /// `lift` above a point of that frame.
    GatherPoint at(const Vec3& position, const Vec3& normal, float lift, FrameIndex frame) const;

    struct Direct {
        Rgb irradiance = Rgb::Zero();  // [W/m²]
        double variance = 0.0;         // of its luminance, from lamps seen in part [W²/m⁴]
    };
    /// From the sources. The variance is that of n scrambled points in a plane cut by a few edges,
    /// about 2 p (1 - p) / n^1.5.
    Direct direct(const GatherPoint& point, const DirectEffort& effort, std::uint64_t key) const;
    /// What of that comes through apertures, and the luminance there would be, nothing between, of
    /// sources that something may hide [W/m²].
    struct ThroughApertures {
        Rgb irradiance = Rgb::Zero();
        double whole = 0.0;
    };
    ThroughApertures through_apertures(const GatherPoint& point, const DirectEffort& effort,
                                       std::uint64_t key) const;
    struct Indirect {
        Rgb irradiance = Rgb::Zero();       // [W/m²]
        Rgb half_difference = Rgb::Zero();  // of what both halves of the rays say [W/m²]
        /// Variance of a luminance, weighed with a reflectance, from the halves [W²/m⁴].
        double variance(const Rgb& reflectance) const;
    };
    /// From all that `field` says is reflected, by `count` rays over the hemisphere, cosine-
    /// weighted, a multiple of 32; where something is much brighter than the rest a quarter as many
    /// samples of it are joined to them with the balance heuristic (Veach & Guibas, "Optimally
    /// Combining Sampling Techniques for Monte Carlo Rendering", 1995).
    Indirect indirect(const GatherPoint& point, const ReflectedField& field, int count,
                      std::uint64_t key) const {
        return indirect(point, field, 0, count, key);
    }
    /// The same by rays [first, end) of the sequence, multiples of 32: the mean of [0, n) and
    /// [n, 2 n) is that of [0, 2 n).
    Indirect indirect(const GatherPoint& point, const ReflectedField& field, int first, int end,
                      std::uint64_t key) const;
    /// The same for surfaces that meet at the point and face nearly as its normal says: one set of
    /// rays about that normal, weighed anew for each of `normals`.
    void indirect(const GatherPoint& point, std::span<const Vec3> normals,
                  const ReflectedField& field, int first, int end, std::uint64_t key,
                  std::span<Indirect> found) const;

  private:
    struct Share {
        float clear = 0.0f, all = 0.0f;  // sums of kernel weights
        bool mixed() const { return clear > 0.0f && clear < all; }
        double clear_share() const { return all > 0.0f ? static_cast<double>(clear / all) : 1.0; }
    };
    struct Samples;
    /// Over the area of a source, weighed with the kernel; or, where it fills much of the view
    /// (`factor`), over directions, all alike: of a wide sky most of the area hardly counts.
    void sample(const GatherPoint& point, const LightSource& source, double factor,
                bool by_apertures, std::uint64_t key, int first, int end, Share& share) const;

    struct Lit {  // by a source that something may hide
        std::size_t source = 0;
        double factor = 0.0;  // nothing between [1]
        double whole = 0.0;   // luminance of what it would give [W/m²]
    };
    /// From one by itself; and from many that give little each, by samples of all together.
    Direct alone(const GatherPoint& point, const Lit& lit, const DirectEffort& effort,
                 std::uint64_t key) const;
    Direct together(const GatherPoint& point, std::span<const Lit> lit, const DirectEffort& effort,
                    std::uint64_t key) const;
    struct ManySamples;

    /// What comes through apertures of the `whole` that sources would give, nothing between [W/m²];
    /// of many, by samples of all together.
    Direct through(const GatherPoint& point, double whole, const DirectEffort& effort,
                   std::uint64_t key) const;
    struct ApertureSamples;

    struct Tilted;
    struct Hemisphere;
    struct Excess;

    const RayScene& rays_;
    std::vector<LightSource> sources_;
    /// A source as it looks from afar.
    struct Afar {
        Vec3 centre, normal;          // centroid [m]
        double area_over_pi = 0.0;    // [m²]
        double squared_radius = 0.0;  // of a sphere round it [m²]
    };
    static Afar make_afar(const LightSource& source);
    /// Form factor to source s with nothing between; of many sources, of those far off, as if all
    /// of it were in its middle, which is wrong by about the share (radius / distance)² of it.
    double factor(const GatherPoint& point, std::size_t s, double may_err) const;

    std::vector<Afar> afar_;  // per source, if they are many
    ApertureSet gaps_, apertures_;
    std::vector<std::uint32_t> source_of_;  // per surface: number and 1
    SobolPoints points_;
};

/// The same with the apertures that are found while `search_on` says so.
PointGather make_gather(const Scene& scene, const RayScene& rays, std::vector<LightSource> sources,
                        int most_samples, std::uint64_t seed,
                        const std::function<bool()>& search_on);

}  // namespace patchlight
