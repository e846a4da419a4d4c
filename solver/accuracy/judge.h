#pragma once

#include "solver/accuracy/check_points.h"
#include "solver/solution.h"

#include <optional>

namespace patchlight {

/// Of the residual, what the error is beside what goes round with the light: neighbours that are
/// wrong alike light others, and few points may miss the worst. Measured on random rooms.
constexpr double passed_on = 1.9;
/// Of the residual carried from point to point: each stands for places that are wrong otherwise.
/// Measured on lamps close below ceilings.
constexpr double flattened = 1.25;
constexpr double sure = 2.0;  // standard errors on top of what is measured

/// What the light of a scene comes to, beside which errors are judged.
struct ReflectedLight {
    double norm = 0.0;                   // √∫ Y(B - E)² dA [W/m]
    double area = 0.0;                   // of all fronts [m²]
    double bounces = 1.0;                // all light sent back over what is sent back at once [1]
    std::vector<double> norm_of_object;  // √∫ Y(B - E)² dA [W/m]
};
/// From patches' means. `once`: irradiance straight from sources, per patch [W/m²].
ReflectedLight measure_reflected(const Scene& scene, const PatchMesh& mesh,
                                 const std::vector<Rgb>& reflected, const std::vector<Rgb>& once);

/// √∫ Y(B - E)² dA of each object as it is displayed, where small bright spots count for what they
/// are and not as means of patches [W/m].
std::vector<double> displayed_norms(const Scene& scene, const PatchMesh& mesh,
                                    const TreeDisplay& shown);

/// All that is known of how wrong a displayed field is. What is absent was not measured.
struct Evidence {
    std::optional<double> target;           // accuracy asked for [1]
    std::optional<double> algebraic_bound;  // of the patch solution [1]
    const CheckReport* checks = nullptr;    // the residual at points
    ReflectedLight light;
    double coarse = 0.0;                   // what rays read is still wrong by, over the norm [1]
    std::optional<double> propagated;      // what the residual makes by further bounces; over the
                                           // norm; absent: guessed from its mean [1]
    std::optional<MeasuredError> carried;  // the error of indirect light, its residual gone round
    EnergyReport energy;
    double proven_by_energy = 0.0;  // the least error that missing light allows, see energy.h [1]
    std::optional<TransportCheck> transport;
};

/// What the residual carried from point to point comes to beyond what `mesh` counts of it, over the
/// norm [1].
double beyond_residual(const Evidence& evidence, double standard_errors);

/// The one place that says how wrong a field is: `mesh` is the residual at check points with
/// `standard_errors` on top; `form_factors` what goes round with the light, or more where the
/// residual carried from point to point comes to more than both; `estimate` is algebraic_bound +
/// √(form_factors² + mesh²) and never less than what the energy that is missing and the particles'
/// flux prove. No estimate where no points were checked.
ErrorReport judge(const Evidence& evidence, double standard_errors = sure);

}  // namespace patchlight
