#pragma once

#include "solver/display/closer_look.h"
#include "solver/display/tree_display.h"
#include "solver/display/vertex_gather.h"

#include <cstdint>

namespace patchlight {

/// A part of the displayed radiosity's error, √∫ Y² dA [W/m], and how sure that is.
struct MeasuredError {
    double square = 0.0;    // mean of what was measured; noise may bring it below 0 [W²/m²]
    double variance = 0.0;  // of `square`
    double mean = 0.0;      // signed, ∫ Y dA [W]
    int points = 0;
    /// With so many standard errors on top; never below 0 [W/m].
    double at_most(double standard_errors) const;
};

/// Of the mean of independent numbers.
MeasuredError mean_of(const std::vector<double>& numbers);

/// A point at which the residual was measured.
struct ResidualPoint {
    GatherPoint place;
    ObjectIndex object = 0;
    double density = 1.0;           // of points [1/m²]
    Rgb reflectance = Rgb::Zero();  // [1]
    Rgb light = Rgb::Zero();        // the irradiance in question as displayed [W/m²]
    std::array<Rgb, 2> missing{Rgb::Zero(), Rgb::Zero()};  // of it, gathered twice [W/m²]
};

struct CheckReport {
    MeasuredError direct, indirect;
    struct OfObject {
        double square = 0.0;    // of both [W²/m²]
        double variance = 0.0;  // of `square`
        int points = 0;
    };
    std::vector<OfObject> of_object;
    /// Irradiance that is missing, ∫ dA over each patch, as every other point tells it: two
    /// estimates that know nothing of each other [W].
    std::array<std::vector<Rgb>, 2> missing;
    std::vector<ResidualPoint> direct_points, indirect_points;
    std::vector<PointMiss> missed;  // points that most of `indirect` is from
    double mean() const { return direct.mean + indirect.mean; }
    /// Both together: their causes are independent [W/m].
    double at_most(double standard_errors) const;
};

/// Of two sets of points that know nothing of each other.
CheckReport joined(const CheckReport& a, const CheckReport& b);

struct CheckEffort {
    int direct_points = 1024;
    DirectEffort direct{64, 1024};
    int indirect_points = 384;
    int rays = 2048;
};

/// The displayed irradiance against what is gathered anew at random points, denser where it is
/// brighter or steeper. Each point is gathered twice, independently: the product of both
/// differences has no share of their noise in the mean. If `field` is what is displayed, this is
/// the residual of the radiosity equation. Where `shown` has no direct part its indirect part is
/// all that arrives.
CheckReport check_display(const Scene& scene, const TreeDisplay& shown, const VertexGather& gather,
                          const ReflectedField& field, const CheckEffort& effort,
                          std::uint64_t seed);

}  // namespace patchlight
