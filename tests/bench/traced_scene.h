#pragma once

#include "solver/scene/polygon.h"
#include "solver/scene/scene.h"
#include "tests/bench/random.h"

#include <array>
#include <optional>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace patchlight {

/// A polygon in its plane, cut into triangles, at which points can be drawn evenly.
struct FlatPolygon {
    PlaneFrame frame;
    std::vector<Vec2> corners;
    std::vector<std::array<Vec2, 3>> triangles;
    std::vector<double> cumulated_area;  // over triangles [m²]
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();

    Vec2 draw(Random& random) const;
};

/// A front on which light landed.
struct LandedAt {
    SurfaceIndex surface = 0;
    Vec3 position = Vec3::Zero();
};

/// The scene as the light tracer sees it: Embree triangles of its own and its own judgement of
/// what covers what.
class TracedScene {
  public:
    explicit TracedScene(const Scene& scene);
    ~TracedScene();
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    const Scene& scene() const { return scene_; }
    const FlatPolygon& flat(SurfaceIndex s) const { return flat_[s]; }

    /// Where a ray from a point of a front lands: nothing if it leaves the scene or meets a back.
    /// Of surfaces that coincide, those that face the ray are hit, of these the one listed last.
    std::optional<LandedAt> land(SurfaceIndex from, const Vec3& position,
                                 const Vec3& direction) const;
    /// Whether nothing is between two points of fronts.
    bool sees(SurfaceIndex from, const Vec3& a, SurfaceIndex to, const Vec3& b) const;
    /// Whether a surface listed later lies on this one there, facing the same way.
    bool is_covered(SurfaceIndex s, const Vec3& position) const;
    /// Whether anything may cover it somewhere.
    bool may_be_covered(SurfaceIndex s) const { return !covers_[s].empty(); }

  private:
    SurfaceIndex first_half(SurfaceIndex s) const { return is_second_half_[s] ? s - 1 : s; }
    /// The half of a surface whose front faces against a direction.
    std::optional<SurfaceIndex> facing(SurfaceIndex first, const Vec3& direction) const;
    Vec3 lifted(SurfaceIndex s, const Vec3& position) const;
    void find_coincident();
    void find_covers();
    void build_triangles();

    const Scene& scene_;
    Vec3 centre_ = Vec3::Zero();  // of most surfaces: where Embree's numbers are finest [m]
    std::vector<FlatPolygon> flat_;
    std::vector<char> is_second_half_;                   // of a two-sided polygon
    std::vector<double> lift_;                           // from where rays leave a surface [m]
    std::vector<std::vector<SurfaceIndex>> coincident_;  // of first halves, with first halves
    std::vector<std::vector<SurfaceIndex>> covers_;      // listed later, facing the same way
    std::vector<std::array<Vec3, 3>> triangles_;
    std::vector<SurfaceIndex> surface_of_;  // of each triangle, a first half
    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* embree_ = nullptr;
};

}  // namespace patchlight
