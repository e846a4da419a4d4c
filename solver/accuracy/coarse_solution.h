#pragma once

#include "solver/accuracy/coarse_transport.h"
#include "solver/mesh/patch_mesh.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight {

/// The light that rays read, on patches: R = S + ρ (D + F R), with D the irradiance that comes
/// straight from sources, as the display found it, and S the exitance of what is no such source.
class CoarseSolution {
  public:
    CoarseSolution(const Scene& scene, const PatchMesh& mesh, const CoarseTransport& transport,
                   std::vector<Rgb> other_exitance);

    /// False if the work was stopped; there is a solution nevertheless.
    bool solve(const std::vector<Rgb>& direct, double tolerance,
               const CoarseTransport::Observe& observe);

    const std::vector<Rgb>& reflected() const { return reflected_; }    // R [W/m²]
    const std::vector<Rgb>& irradiance() const { return irradiance_; }  // F R [W/m²]
    const std::vector<Rgb>& reflectance() const { return reflectance_; }
    double norm() const { return norm_; }  // √∫ Y(R - S)² dA [W/m]
    const Transported& transported() const { return transported_; }

    /// Rays read the field R and what was gathered makes it R', patch means `change` apart. R' has
    /// the residual ρ G (R' - R) for the exact transport G: solving for that with the coarse one
    /// corrects it (Atkinson, "The Numerical Solution of Integral Equations of the Second Kind",
    /// 1997, chapter 6: two-grid iteration).
    struct Correction {
        std::vector<Rgb> irradiance;  // to be added [W/m²]
        double size = 0.0;            // of what it changes in the radiosity, over `norm` [1]
    };
    Correction correct(const std::vector<Rgb>& change, double tolerance) const;

    /// Whether there is a matrix to send light on with.
    bool goes_round() const { return transport_.has_matrix(); }
    /// What light that is missing on patches, ∫ dA of its irradiance on each [W], comes to once it
    /// has gone round: (I - ρF)^-1 ρ e per patch [W/m²]. None without a matrix.
    std::optional<std::vector<Rgb>> gone_round(const std::vector<Rgb>& missing,
                                               double tolerance) const;

    /// The channels in use of values per patch.
    Field to_field(const std::vector<Rgb>& values) const;

  private:
    double norm_of(const std::vector<Rgb>& values) const;

    const CoarseTransport& transport_;
    std::size_t channels_ = 3;
    std::vector<double> area_;         // [m²]
    std::vector<Rgb> reflectance_;     // [1]
    std::vector<Rgb> other_exitance_;  // S [W/m²]
    std::vector<Rgb> reflected_, irradiance_;
    Transported transported_;
    double norm_ = 0.0;
};

}  // namespace patchlight
