#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/scene.h"
#include "solver/settings.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patchlight {

/// The field that pictures show: radiosity at vertices, linear in between. A vertex belongs to one
/// object and one smooth surface; covered patches are left out.
struct DisplayMesh {
    std::vector<Vec3> positions;                          // [m]
    std::vector<Rgb> radiosity;                           // at each vertex [W/m²]
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from the front
    std::vector<PatchIndex> patch;                        // which patch each triangle belongs to
};

/// Where the light went, summed over all patches [W].
struct EnergyReport {
    Rgb emitted = Rgb::Zero();
    Rgb absorbed = Rgb::Zero();  // by fronts
    Rgb backs = Rgb::Zero();     // by backs of one-sided surfaces
    Rgb escaped = Rgb::Zero();
    double defect = 0.0;          // largest |emitted - absorbed - backs - escaped| / emitted [1]
    double standard_error = 0.0;  // of the defect: rays tell what escapes or meets backs [1]
    Rgb missing() const { return emitted - absorbed - backs - escaped; }
};

/// The displayed field against the flux of particles that start at lamps and bounce by themselves.
/// Errors as those of `ErrorReport` [1].
struct TransportCheck {
    double proven = 0.0;          // beyond two standard errors in each region: a lower bound
    double difference = 0.0;      // √ of the mean square that is no noise
    double standard_error = 0.0;  // of `difference`
    double doubt = 0.0;           // what lamps may light that no particle showed
    std::uint64_t particles = 0;
    std::uint64_t rays = 0;
};

/// Errors of the displayed field, √∫ Y² dA over √∫ Y(B − E)² dA [1].
struct ErrorReport {
    std::optional<double> target;    // accuracy asked for
    std::optional<double> estimate;  // algebraic_bound + √(form_factors² + mesh²), and no less
                                     // than what particles and the energy prove
    std::optional<double> algebraic_bound;  // rigorous, against the stored matrix
    std::optional<double> form_factors;     // estimated: of the light between patches
    std::optional<double> mesh;  // estimated: of gathering at vertices and linear interpolation
    struct Worst {
        ObjectIndex object = 0;
        double estimate = 0.0;  // relative to the light the object itself sends back
    };
    std::optional<Worst> worst;
    std::vector<std::optional<double>> of_object;  // relative to its own light; absent: unknown
    std::optional<TransportCheck> transport;
    double unbalanced = 0.0;  // the energy's defect less two standard errors [1]
    bool met() const { return target && estimate && *estimate <= *target && unbalanced <= *target; }
};

/// Defects of a matrix: closure is row_sum + backs + escaped = 1, reciprocity A_i F_ij = A_j F_ji.
struct ClosureReport {
    double row_sum_min = 0.0;
    double row_sum_max = 0.0;
    double row_sum_mean = 0.0;     // area-weighted
    double closure_max = 0.0;      // largest |row_sum + backs + escaped - 1|
    double reciprocity_max = 0.0;  // largest |A_i F_ij - A_j F_ji| / min(A_i, A_j)
};

/// What the error of hemicube form factors is made of: the share of a patch's light that one cause
/// sends to the wrong patch, mean over a sample of patches [1].
struct HemicubeErrors {
    double proximity = 0.0;   // a patch is not far for its size
    double visibility = 0.0;  // its centre does not see what the whole of it sees
    double aliasing = 0.0;    // a cell sees one patch only
};

struct FormFactorReport {
    ClosureReport measured;  // as the engine gave them
    ClosureReport repaired;  // as they were used
    std::uint64_t rays = 0;
    bool open = false;                       // light escapes
    std::optional<HemicubeErrors> hemicube;  // of that engine alone
};

struct ConvergenceStep {
    int iteration = 0;
    double seconds = 0.0;  // since the solve began
    double residual = 0.0;  // ‖E + ρFB − B‖ / ‖E‖, area-weighted 2-norm, worst channel [1]
    std::optional<double> unshot = std::nullopt;  // share of the light not yet sent on [1]
};

struct ObjectReport {
    double area = 0.0;             // [m²]
    Rgb radiosity = Rgb::Zero();   // area mean [W/m²]
    Rgb irradiance = Rgb::Zero();  // area mean [W/m²]
    Rgb emitted = Rgb::Zero();     // [W]
    Rgb min = Rgb::Zero();         // of radiosity over the display field [W/m²]
    Rgb max = Rgb::Zero();
};

struct SensorReport {
    Rgb irradiance = Rgb::Zero();  // gathered at the point [W/m²]
    double error = 0.0;  // the true value lies within two of them in 95 of 100, luminance [W/m²]
    double reflected = 0.0;  // of it, what surfaces sent back, luminance [W/m²]
};

struct StageSeconds {
    double mesh = 0.0;
    double form_factors = 0.0;
    double solve = 0.0;
    double display = 0.0;
    double measuring = 0.0;  // of the above: errors measured that nothing shown depends on
};

enum class Status : std::uint8_t { converged, limit, cancelled };

struct Solution {
    Status status = Status::converged;
    bool within_tolerance = false;  // algebraic_bound <= tolerance
    SolveSettings settings;         // with every choice made
    std::string why;                // one sentence: why this engine and this method
    PatchMesh mesh;
    std::vector<Rgb> radiosity;   // per patch [W/m²]
    std::vector<Rgb> irradiance;  // per patch [W/m²]
    DisplayMesh display;
    ErrorReport error;
    EnergyReport energy;
    FormFactorReport form_factors;
    std::vector<ConvergenceStep> convergence;
    std::vector<ObjectReport> objects;  // as in scene.objects
    std::vector<SensorReport> sensors;  // as in scene.sensors; the first of them if work ended
    std::vector<bool> misplaced;        // as in scene.sensors: lies in a solid or outside the room
    std::vector<Finding> findings;
    StageSeconds seconds;
};

}  // namespace patchlight
