#pragma once

#include "solver/display/near_places.h"
#include "solver/hierarchy/alike_parts.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace patchlight {

/// Irradiance at a place, and how it changes as the surface tilts.
struct IrradianceRecord {
    Vec3 position = Vec3::Zero();  // [m]
    Vec3 normal = Vec3::UnitZ();   // unit
    Rgb irradiance = Rgb::Zero();  // [W/m²]
    std::array<Vec3, 2> axis{};    // unit, across the normal
    /// Of the irradiance, by the tilt of the normal towards each axis [W/m² per radian].
    std::array<Rgb, 2> by_tilt{Rgb::Zero(), Rgb::Zero()};
    double variance = 0.0;  // of what is reflected of it, luminance [W²/m⁴]
    bool known = false;     // else the work was stopped before it was gathered

    /// On a surface there that faces otherwise, to the first order.
    Rgb on(const Vec3& facing) const;
};

/// Irradiance on surfaces cut much finer than the light on them varies: gathered at some places
/// and between them the plane that fits best to those around (Ward, Rubinstein & Clear, "A Ray
/// Tracing Solution for Diffuse Interreflection", 1988, gathers at scattered places; moving least
/// squares: Lancaster & Salkauskas 1981). Parts of the places are halved as long as what is
/// gathered in a half differs from what was expected there.
class IrradianceRecords {
  public:
    /// Records at those of `places`, in their order.
    using Gather = std::function<std::vector<IrradianceRecord>(std::span<const std::uint32_t>)>;

    /// Whether nothing stands between two places, as seen from a little above them.
    using Sees = std::function<bool(std::uint32_t, std::uint32_t)>;

    struct Rule {
        double may_miss = 0.0;                // of what is reflected, luminance [W/m²]
        std::size_t fewest = 1000;            // records
        std::span<const double> reflectance;  // luminance, at each place [1]
    };

    IrradianceRecords(std::span<const FacingPlace> places, const Rule& rule, const Gather& gather,
                      const Sees& sees);

    /// Whether all was gathered that should be.
    bool complete() const { return complete_; }
    std::size_t size() const { return records_.size(); }

    /// At place k on a surface that faces as said, and its variance [W²/m⁴].
    struct Value {
        Rgb irradiance = Rgb::Zero();
        double variance = 0.0;
        bool known = false;
    };
    Value at(std::uint32_t k, const Vec3& facing) const;

  private:
    struct Part {
        AlikeParts::Part places;
        std::uint32_t record = 0;  // in the middle
        double radius = 0.0;       // of its places round the record's [m]
        bool settled = false;      // nothing tells that more is missed than may be
        bool apart = false;        // something stands between its places
        bool alone() const { return places.end - places.first < 2; }
    };
    void begin(std::size_t parts);
    bool halve();
    void judge();
    std::vector<IrradianceRecord> gather_together(std::span<const std::uint32_t> wanted) const;
    std::uint32_t middle_of(const AlikeParts::Part& part);
    void look_over(Part& part);
    NearPlaces places_of_records() const;
    std::vector<std::uint32_t> records_near(const NearPlaces& near, const FacingPlace& place,
                                            double radius) const;
    std::vector<std::uint32_t> seen_from(std::uint32_t place,
                                         std::vector<std::uint32_t> records) const;
    struct Plane;
    Plane plane(std::span<const std::uint32_t> records, const FacingPlace& place) const;
    Value fit(const Plane& plane, const Vec3& facing) const;
    struct Roughness {
        double square = 0.0, noise = 0.0;  // [W²/m⁴]; the noise of what is reflected
    };
    Roughness roughness(const Plane& plane, const Vec3& facing) const;
    bool is_missed(const IrradianceRecord& found, std::uint32_t place, const Plane& around) const;
    bool is_rough(std::uint32_t place, const Plane& around) const;
    double allowed() const;  // square of what one halving may leave [W²/m⁴]

    std::span<const FacingPlace> places_;
    Rule rule_;
    const Gather& gather_;
    const Sees& sees_;
    AlikeParts cutter_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> part_of_;            // per place
    std::vector<std::vector<std::uint32_t>> near_;  // records, per part
    std::vector<std::vector<std::uint32_t>> seen_;  // those of them that its record's place sees
    std::vector<IrradianceRecord> records_;
    std::vector<std::uint32_t> place_of_;  // per record
    bool complete_ = true;
};

}  // namespace patchlight
