#pragma once

#include "server/chart/chart.h"
#include "server/job.h"
#include "solver/accuracy/field_difference.h"

#include <optional>
#include <vector>

namespace patchlight::server {

/// The radiosity of every surface, if it can be told without solving: where all have one
/// reflectance and one exitance and no light is lost, B = E / (1 − ρ) everywhere. `solution` tells
/// whether light escapes or meets backs.
std::optional<Rgb> known_radiosity(const Scene& scene, const Solution& solution);

/// What solutions are held against, at 16384 points of equal area; or at the sensors, where nothing
/// reflects.
class ChartTruth {
  public:
    /// `solution` is taken as right, unless the answer is known. Its display says what of the
    /// surfaces is to be seen.
    ChartTruth(const Scene& scene, Solution solution);

    /// √(∫ Y(B̃ − B)² dA / ∫ Y(B − E)² dA) over all fronts; where nothing reflects the largest
    /// error at a sensor, relative to the largest irradiance. Absent if there is nothing to err
    /// about [1].
    std::optional<double> error_of(const Solution& solution) const;

    bool is_known() const { return is_known_; }
    bool is_at_sensors() const { return level_ <= 0.0; }
    /// √(∫ Y(B − E)² dA / ∫ dA) [W/m²].
    double level() const { return level_; }
    const Solution& solution() const { return solution_; }

  private:
    const Scene* scene_;  // never null
    Solution solution_;
    bool is_known_ = false;
    std::vector<ComparedPoint> points_;
    std::vector<double> reflected_;  // at each point [W/m²]
    double level_ = 0.0;
};

}  // namespace patchlight::server
