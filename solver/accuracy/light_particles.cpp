#include "solver/accuracy/light_particles.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace patchlight {

namespace {

constexpr double by_power = 0.75;  // of the particles; the rest is shared alike by lamps, since
                                   // what lights a room may be its weakest [1]

}  // namespace

LightParticles::LightParticles(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                               const ApertureSet& apertures)
    : scene_(scene), mesh_(mesh), rays_(rays), apertures_(apertures) {
    RayPoint low = RayPoint::Constant(1e30f), high = -low;
    for (const Surface& surface : scene.surfaces) {
        if (!(scene.materials[surface.material].reflectance > 0.0).any()) continue;
        for (const Vec3& corner : surface.corners) {
            low = low.cwiseMin(rays.to_ray_space(corner));
            high = high.cwiseMax(rays.to_ray_space(corner));
        }
    }
    centre_ = 0.5f * (low + high);
    radius_ = 0.5f * (high - low).norm();
    for (const Surface& surface : scene.surfaces) {
        const Rgb& reflectance = scene.materials[surface.material].reflectance;
        reflectance_.push_back({static_cast<float>(reflectance[0]),
                                static_cast<float>(reflectance[1]),
                                static_cast<float>(reflectance[2])});
        normals_.push_back(surface.normal.cast<float>());
        const Rgb& exitance = scene.materials[surface.material].exitance;
        exitance_.push_back({static_cast<float>(exitance[0]), static_cast<float>(exitance[1]),
                             static_cast<float>(exitance[2])});
    }
    std::map<ObjectIndex, std::uint32_t> lamps;
    const auto exitance_of = [&](PatchIndex i) {
        return scene.materials[scene.surfaces[mesh.patches[i].surface].material].exitance;
    };
    double total = 0.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        double power = mesh.patches[i].area * luminance(exitance_of(i));
        if (mesh.patches[i].covered || !(power > 0.0)) continue;
        const Cone cone = cone_from(rays.to_ray_space(mesh.patches[i].centre));
        if (cone.cosine > 0.0f) {  // about what it sends there
            const SurfaceIndex s = mesh.patches[i].surface;
            const float sine = std::sqrt(1.0f - cone.cosine * cone.cosine),
                        facing = cone.axis.dot(scene.surfaces[s].normal.cast<float>());
            if (facing < -sine) continue;
            power *=
                static_cast<double>(2.0f * (1.0f - cone.cosine) * std::max(0.5f * sine, facing));
        }
        const ObjectIndex object = scene.surfaces[mesh.patches[i].surface].object;
        const std::uint32_t lamp =
            lamps.try_emplace(object, static_cast<std::uint32_t>(lamps.size())).first->second;
        if (lamp == lamp_power_.size()) lamp_power_.push_back(0.0);
        lamp_power_[lamp] += power;
        total += power;
        emitters_.push_back({i, lamp, power, {}});
    }
    double cumulative = 0.0;
    const double alike =
        (1.0 - by_power) / static_cast<double>(std::max<std::size_t>(1, lamp_power_.size()));
    for (Emitter& emitter : emitters_) {
        const double power = emitter.cumulative,
                     chance = by_power * power / total + alike * power / lamp_power_[emitter.lamp];
        const Rgb flux = mesh.patches[emitter.patch].area * exitance_of(emitter.patch) / chance;
        for (std::size_t c = 0; c < 3; ++c)
            emitter.flux[c] = static_cast<float>(flux[static_cast<Eigen::Index>(c)]);
        emitter.cumulative = cumulative += chance;
    }
    for (Emitter& emitter : emitters_) emitter.cumulative /= cumulative;
    find_beams();
}

/// Half of them by what may come through, half all alike.
void LightParticles::find_beams() {
    constexpr double wide = 0.02;  // of the view
    const double many = static_cast<double>(apertures_.size());
    double all = 0.0, cumulative = 0.0;
    for (std::size_t g = 0; g < apertures_.size(); ++g)
        for (const ApertureSet::Lit& lit : apertures_.lit(g))
            all += lit.irradiance * static_cast<double>(apertures_[g].area);
    for (std::size_t g = 0; g < apertures_.size(); ++g) {
        const auto& [front, back] = apertures_.lit(g);
        const double light = front.irradiance + back.irradiance,
                     power = light * static_cast<double>(apertures_[g].area);
        Beam beam;
        beam.chance = static_cast<float>(0.5 / many + (all > 0.0 ? 0.5 * power / all : 0.5 / many));
        beam.cumulative = cumulative += static_cast<double>(beam.chance);
        beam.of_side[0] = static_cast<float>(light > 0.0 ? front.irradiance / light : 0.5);
        beam.of_side[1] = 1.0f - beam.of_side[0];
        beam.is_wide = front.factor + back.factor > wide;
        beams_.push_back(beam);
    }
}

LightParticles::Cone LightParticles::cone_from(const RayPoint& point) const {
    constexpr float near = 1.25f;  // radii: not worth a cone
    if (rays_.frames() > 1) return {};
    const RayPoint to = centre_ - point;
    const float distance = to.norm();
    if (!(distance > near * radius_)) return {};
    const float sine = radius_ / distance;
    return {to / distance, std::sqrt(1.0f - sine * sine)};
}

}  // namespace patchlight
