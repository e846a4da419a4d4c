#pragma once

#include "tests/bench/density_tree.h"
#include "tests/bench/traced_scene.h"

#include <optional>
#include <span>
#include <vector>

namespace patchlight {

/// Light on its way from a lamp. The mean of `light` over all launches is the light given off [W].
struct Launch {
    std::size_t lamp = 0;
    SurfaceIndex surface = 0;
    Place place = Place::Zero();  // on the lamp's plane [m], and on the disc below its hemisphere
    Vec3 position = Vec3::Zero();
    Vec3 direction = Vec3::Zero();
    Rgb light = Rgb::Zero();
};

/// Light of a lamp that came to use: from where it started, and how much it matters.
struct UsefulLight {
    std::size_t lamp = 0;
    Place place = Place::Zero();
    double flux = 0.0;        // that is reflected where it first lands, luminance [W]
    double importance = 0.0;  // flux times the radiosity there
};

/// Where light starts: in part as lamps give it off, evenly over them and by the cosine; in part
/// where it is known to come to use. Whatever is chosen how often, its mean is the same.
class Emission {
  public:
    explicit Emission(const TracedScene& traced);

    bool is_dark() const { return lamps_.empty(); }
    std::size_t lamps() const { return lamps_.size(); }
    SurfaceIndex surface(std::size_t lamp) const { return lamps_[lamp].surface; }
    /// Nothing in its light if a cover or the polygon's edge takes it.
    Launch launch(Random& random) const;
    /// A lamp, as for launches that nothing is known of, with its chance.
    std::size_t any_lamp(Random& random) const;
    double chance_of(std::size_t lamp) const { return lamps_[lamp].plain; }
    /// Light per area and unit of the disc [W].
    Rgb intensity(std::size_t lamp) const;
    /// Of launches, on a lamp's area and disc; over all lamps it integrates to 1.
    double density(std::size_t lamp, const Place& place) const;

    /// From which lamps light comes to use and, if asked, from where on them and to where.
    void learn(std::span<const UsefulLight> useful, bool guide);

  private:
    struct Lamp {
        SurfaceIndex surface = 0;
        double area = 0.0, power = 0.0;    // luminance
        double unlearned = 0.0;            // chance while nothing is known
        double plain = 0.0, guided = 0.0;  // chance of either
        std::vector<double> heights{};     // of planes in front that may hold gaps [m]
        double height = 0.0;               // of that in which the guide counts places [m]
        std::optional<DensityTree> guide{};
    };
    static Place raised(const Place& place, double height);
    void find_heights(Lamp& lamp) const;
    static void teach(Lamp& lamp, std::vector<WeightedPlace> samples);
    void set_chances(std::span<const double> share);

    const TracedScene& traced_;
    std::vector<Lamp> lamps_;
    std::vector<double> cumulated_;  // chances: plain of all lamps, then guided of all
};

}  // namespace patchlight
