#include "server/chart/chart_truth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patchlight::server {

namespace {
constexpr std::size_t point_count = std::size_t{1} << 14;
constexpr double rounding =
    1e-12;  // of the brightest, that B − E leaves where nothing is reflected
}  // namespace

std::optional<Rgb> known_radiosity(const Scene& scene, const Solution& solution) {
    if (scene.surfaces.empty() || solution.convergence.empty()) return std::nullopt;
    const auto material_of = [&](const Surface& surface) -> const Material& {
        return scene.materials[surface.material];
    };
    const Material& first = material_of(scene.surfaces.front());
    const bool is_alike =
        std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
            const Material& other = material_of(surface);
            return (other.reflectance == first.reflectance).all() &&
                   (other.exitance == first.exitance).all();
        });
    const bool is_closed = !solution.form_factors.open && (solution.energy.escaped <= 0.0).all() &&
                           (solution.energy.backs <= 0.0).all();
    if (!is_alike || !is_closed) return std::nullopt;
    return first.exitance / (1.0 - first.reflectance);
}

ChartTruth::ChartTruth(const Scene& scene, Solution solution)
    : scene_(&scene), solution_(std::move(solution)) {
    if (const auto known = known_radiosity(scene, solution_)) {
        is_known_ = true;
        solution_.display.radiosity.assign(solution_.display.positions.size(), *known);
        solution_.radiosity.assign(solution_.mesh.size(), *known);
    }
    points_ = spread_points(solution_, point_count);
    reflected_ = reflected_at(scene, DisplayedField(scene, solution_), points_);
    double brightest = 0.0;
    for (const Rgb& radiosity : solution_.display.radiosity)
        brightest = std::max(brightest, luminance(radiosity));
    for (const double reflected : reflected_) level_ += reflected * reflected;
    if (!points_.empty()) level_ = std::sqrt(level_ / static_cast<double>(points_.size()));
    if (level_ <= rounding * brightest) level_ = 0.0;
}

std::optional<double> ChartTruth::error_of(const Solution& solution) const {
    if (is_at_sensors()) return relative_difference(solution.sensors, solution_.sensors);
    return relative_difference(reflected_at(*scene_, DisplayedField(*scene_, solution), points_),
                               reflected_);
}

}  // namespace patchlight::server
