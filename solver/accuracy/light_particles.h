#pragma once

#include "solver/display/aperture_set.h"
#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// Where a flight of a particle ended on a front.
struct ParticleLanding {
    RayPoint position;  // in the frame of its surface [ray space]
    SurfaceIndex surface = 0;
    std::array<float, 3> flux{};  // that arrives with it [W]
    std::uint32_t path = 0;       // number of the particle
    std::uint16_t bounces = 0;    // before; 0: straight from the lamp
};

/// The particles of one object that gives off light.
struct LampFate {
    double power = 0.0;  // luminance of what it gives off towards what sends light back [W]
    std::uint64_t particles = 0;
};

struct ParticleFlux {
    std::vector<ParticleLanding> landings;
    std::vector<LampFate> lamps;
    std::uint64_t particles = 0, rays = 0;
};

/// Sends light out from all that gives off light, and from nothing else: each particle starts on an
/// emitting patch, by its power, carries its flux from bounce to bounce, dims by the reflectances
/// it meets, and ends by Russian roulette, on a back or outside. Nothing is read that a solve
/// found, so that what lands is evidence of its own. Lamps far off what sends light back aim there;
/// where there are apertures half the particles aim through them, and the others leave those out.
class LightParticles {
  public:
    /// `apertures` must outlive it.
    LightParticles(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                   const ApertureSet& apertures);

    bool empty() const { return emitters_.empty(); }
    /// Landings of `count` particles, in order of their numbers.
    ParticleFlux send(std::size_t count, std::uint64_t seed) const;

  private:
    struct Emitter {
        PatchIndex patch = 0;
        std::uint32_t lamp = 0;       // number of its object among those that give off light
        double cumulative = 0.0;      // of the chance to be picked, ends at 1
        std::array<float, 3> flux{};  // of one particle, times their number [W]
    };
    struct Beam {                 // through an aperture
        double cumulative = 0.0;  // of the chance to be picked, ends at 1
        float chance = 0.0f;
        std::array<float, 2> of_side{};  // chance that light is looked for there
        /// Lamps fill so much of what is seen from it that directions find them; else they are
        /// picked by their power.
        bool is_wide = false;
    };
    void find_beams();
    struct Flight;
    struct Tracer;
    /// Round all that sends light back, as seen from a point.
    struct Cone {
        RayPoint axis;
        float cosine = 0.0f;  // of half its angle; 0: the whole half space
    };
    Cone cone_from(const RayPoint& point) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    const ApertureSet& apertures_;
    RayPoint centre_;  // of a sphere round all that sends light back [ray space]
    float radius_ = 0.0f;
    std::vector<Emitter> emitters_;
    std::vector<Beam> beams_;                        // per aperture
    std::vector<std::array<float, 3>> exitance_;     // per surface [W/m²]
    std::vector<double> lamp_power_;                 // luminance [W]
    std::vector<std::array<float, 3>> reflectance_;  // per surface [1]
    std::vector<RayPoint> normals_;
};

}  // namespace patchlight
