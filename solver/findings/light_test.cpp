#include "solver/findings/light_test.h"

#include "solver/rays/low_discrepancy.h"

#include <algorithm>

namespace patchlight {

LightTest::LightTest(const FlawSearch& search) : search_(search) {
    double total = 0.0;
    for (SurfaceIndex s = 0; s < search.scene.surfaces.size(); ++s) {
        const Surface& surface = search.scene.surfaces[s];
        power_.push_back(surface.area *
                         luminance(search.scene.materials[surface.material].exitance));
        if (!(power_[s] > 0.0)) continue;
        emitters_.push_back(s);
        points_.emplace_back(surface);
        up_to_.push_back(total += power_[s]);
    }
}

bool LightTest::sees_lamp(const RayPoint& p, FrameIndex frame, const RayPoint& normal,
                          std::uint64_t seed) const {
    if (emitters_.empty()) return false;
    const double drawn = uniform_of(mix(seed, 7)) * up_to_.back();
    const auto found = std::upper_bound(up_to_.begin(), up_to_.end() - 1, drawn);
    const auto k = static_cast<std::size_t>(found - up_to_.begin());
    const SurfaceIndex s = emitters_[k];
    const RayPoint lamp_normal = search_.scene.surfaces[s].normal.cast<float>();
    const RayPoint lamp =
        search_.rays.to_ray_space(points_[k].at(mix(seed, 8)), search_.rays.frame(s)) +
        search_.rays.lift(s) * lamp_normal;
    const RayPoint shift = search_.rays.shift(search_.rays.frame(s), frame).cast<float>();
    const RayPoint way = lamp + shift - p;
    if (way.dot(normal) <= 0.0f || way.dot(lamp_normal) >= 0.0f) return false;
    RayBatch segment{};
    RayScene::set_segment(segment, 0, p, frame, way, lamp, search_.rays.frame(s));
    return search_.rays.blocked(segment, 1) == 0;
}

}  // namespace patchlight
