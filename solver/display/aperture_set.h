#pragma once

#include "solver/display/aperture.h"
#include "solver/display/light_sources.h"

#include <span>
#include <vector>

namespace patchlight {

/// The apertures of a scene side by side, so that all are asked at once.
class ApertureSet {
  public:
    ApertureSet() = default;
    ApertureSet(const std::vector<Aperture>& apertures, const std::vector<LightSource>& sources,
                const RayScene& rays);

    void add(const Aperture& aperture);
    bool empty() const { return apertures_.empty(); }
    std::size_t size() const { return apertures_.size(); }
    const Aperture& operator[](std::size_t g) const { return apertures_[g]; }
    const std::vector<Aperture>& all() const { return apertures_; }

    /// How many the segment from `origin` along `ray` crosses. Each that is sampled by itself
    /// counts a ray that crosses n of them 1/n times, and who samples lamps leaves out the rays
    /// that cross any: so all light counts once, wherever apertures were found.
    int count_crossed(const RayPoint& origin, const RayPoint& ray) const;

    /// Of each, no less than the irradiance that sources send through it to a point above whose
    /// plane it lies [W/m²]; 0 where none is seen through it: a bound by spheres round both.
    void most_through(const RayPoint& origin, const RayPoint& normal, std::span<float> most) const;

    /// What sources would light one side of it, nothing between.
    struct Lit {
        double irradiance = 0.0;  // luminance, in the middle [W/m²]
        double factor = 0.0;      // of all sources together [1]
    };
    /// From the side its normal points to, and from the other.
    const std::array<Lit, 2>& lit(std::size_t g) const { return lit_[g]; }

  private:
    struct Glow {  // sources close together
        RayPoint centre;
        float radius = 0.0f;
        float exitance = 0.0f;  // of the brightest [W/m²]
    };
    void find_lit(const std::vector<LightSource>& sources, const RayScene& rays);
    void find_glows(const std::vector<LightSource>& sources, const RayScene& rays);

    std::vector<Aperture> apertures_;
    std::vector<std::array<Lit, 2>> lit_;
    enum Field : std::size_t {
        corner_x,
        corner_y,
        corner_z,
        normal_x,
        normal_y,
        normal_z,
        first_x,
        first_y,
        first_z,
        second_x,
        second_y,
        second_z,
        middle_x,
        middle_y,
        middle_z,
        radius,
        area,
        fields
    };
    std::array<std::vector<float>, fields> side_by_side_;
    std::vector<Glow> glows_;
};

}  // namespace patchlight
