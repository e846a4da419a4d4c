#include "server/doubts.h"

#include "server/wording.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace patchlight::server {
namespace {

using Box = Eigen::AlignedBox3d;

std::string rounded_text(double number) {
    const double digits = 2.0 - std::floor(std::log10(number));  // behind the point, or before it
    const double power = std::pow(10.0, std::abs(digits));
    return number_text(digits >= 0.0 ? std::round(number * power) / power
                                     : std::round(number / power) * power);
}

/// Half the objects are larger: one plane far out does not make a scene large.
double median_size(const std::vector<Box>& boxes) {
    std::vector<double> sizes;
    for (const Box& box : boxes)
        if (!box.isEmpty()) sizes.push_back(box.diagonal().norm());
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

/// The unit in which as many lengths are most like a room: 5 m across, by ratio.
std::pair<const char*, double> likely_unit(double lengths) {
    constexpr std::array<std::pair<const char*, double>, 3> units{
        {{"m", 1.0}, {"mm", 0.001}, {"cm", 0.01}}};
    const auto unlikeness = [&](const auto& unit) {
        return std::abs(std::log(lengths * unit.second / 5.0));
    };
    return *std::min_element(units.begin(), units.end(), [&](const auto& a, const auto& b) {
        return unlikeness(a) < unlikeness(b);
    });
}

void doubt_size(const Job& job, std::vector<Finding>& found) {
    constexpr double largest = 500.0, largest_object = 100.0, smallest = 0.03;  // [m]
    if (job.scene.surfaces.empty()) return;
    Box all;
    std::vector<Box> boxes(job.scene.objects.size());
    for (const Surface& surface : job.scene.surfaces)
        for (const Vec3& p : surface.corners) {
            all.extend(p);
            boxes[surface.object].extend(p);
        }
    const double size = all.diagonal().norm();
    const bool too_large = size > largest && median_size(boxes) > largest_object;
    if (!too_large && size >= smallest) return;
    const double lengths = size / job.units.metres;
    const auto [unit, metres] =
        likely_unit(too_large ? median_size(boxes) / job.units.metres : lengths);
    found.push_back(
        {"unlikely-size",
         {},
         "the scene is " + rounded_text(size) + " m across, with lengths in " + job.units.length,
         std::string("if lengths are in ") + unit + ", say so in `units`: then it is " +
             rounded_text(lengths * metres) + " m; or give an object from a file the `scale` " +
             number_text(metres / job.units.metres),
         1});
}

void doubt_angle(const NamedCamera& named, std::vector<Finding>& found) {
    const double fov = named.camera.vertical_fov;
    const bool is_perspective = named.camera.projection == raster::Projection::perspective;
    if (named.is_made || !is_perspective || fov > std::numbers::pi) return;
    found.push_back({"narrow-view",
                     {},
                     "the camera " + in_quotes(named.name) + " has a vertical_fov of " +
                         number_text(fov) + ", which is in degrees",
                     "if it is in radians, write " + rounded_text(fov * 180.0 / std::numbers::pi),
                     1});
}

}  // namespace

std::vector<Finding> doubts(const Job& job) {
    std::vector<Finding> found;
    doubt_size(job, found);
    for (const NamedCamera& camera : job.cameras) doubt_angle(camera, found);
    return found;
}

}  // namespace patchlight::server
