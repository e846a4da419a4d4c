#pragma once

#include "solver/accuracy/check_points.h"
#include "solver/solution.h"

namespace patchlight {

/// Of the residual, what the error is: light that is wrong at one place lights others. Measured on
/// random rooms; what is wrong everywhere alike is treated by itself.
constexpr double passed_on = 1.9;

/// What the light of a scene comes to, beside which errors are judged.
struct ReflectedLight {
    double norm = 0.0;                   // √∫ Y(B - E)² dA [W/m]
    double area = 0.0;                   // of all fronts [m²]
    double bounces = 1.0;                // all light sent back over what is sent back at once [1]
    std::vector<double> norm_of_object;  // √∫ Y(B - E)² dA [W/m]
};
/// `once`: irradiance straight from sources, per patch [W/m²].
ReflectedLight measure_reflected(const Scene& scene, const PatchMesh& mesh,
                                 const std::vector<Rgb>& reflected, const std::vector<Rgb>& once);

constexpr double sure = 2.0;  // standard errors on top of what is measured

/// Fills in the estimates from what was measured at check points. `mesh` is the residual there,
/// with `standard_errors` on top. What of the residual is alike everywhere, its mean, goes round
/// with the light and adds up: that and `coarse`, an estimate of the caller's, are `form_factors`.
void estimate_error(const CheckReport& checks, const ReflectedLight& light, double coarse,
                    double standard_errors, ErrorReport& error);

}  // namespace patchlight
