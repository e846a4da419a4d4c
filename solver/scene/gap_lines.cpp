#include "solver/scene/gap_lines.h"

#include "solver/scene/local_tolerance.h"
#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace patchlight {

namespace {

constexpr double opposed = -0.95;         // cosine between normals
constexpr double least_of_area = 2e-4;    // of the scene's: smaller ones change little
constexpr double least_to_and_fro = 0.4;  // of the light that leaves a side, what comes back so
constexpr double widest = 1.0;            // height over width, of what may reach that at all

/// Form factor between two equal rectangles a x b that face each other at distance h (Hottel,
/// "Radiant-heat transmission", 1931).
double facing_factor(double a, double b, double h) {
    const double x = a / h, y = b / h, x1 = 1.0 + x * x, y1 = 1.0 + y * y;
    return 2.0 / (std::numbers::pi * x * y) *
           (0.5 * std::log(x1 * y1 / (x1 + y * y)) +
            x * std::sqrt(y1) * std::atan(x / std::sqrt(y1)) +
            y * std::sqrt(x1) * std::atan(y / std::sqrt(x1)) - x * std::atan(x) - y * std::atan(y));
}

double most_reflected(const Scene& scene, const Surface& s) {
    return scene.materials[s.material].reflectance.maxCoeff();
}

/// How high `other` lies above the plane of `s`, if all of it does and light goes to and fro.
double height_of_gap(const Scene& scene, const Surface& s, const Surface& other, double reach) {
    if (s.normal.dot(other.normal) > opposed) return 0.0;
    const double reflected = std::sqrt(most_reflected(scene, s) * most_reflected(scene, other));
    if (reflected < least_to_and_fro) return 0.0;
    const PlaneFrame frame = frame_along(s.corners, s.normal);
    Eigen::AlignedBox2d below, above;
    for (const Vec3& p : s.corners) below.extend(frame.flat(p));
    double least = std::numeric_limits<double>::infinity(), sum = 0.0;
    for (const Vec3& p : other.corners) {
        above.extend(frame.flat(p));
        const double height = (p - frame.origin).dot(frame.normal);
        least = std::min(least, height);
        sum += height / static_cast<double>(other.corners.size());
    }
    if (least <= reach) return 0.0;
    const Vec2 common = below.intersection(above).sizes();
    if (!(common.minCoeff() > 0.0) || sum > widest * common.minCoeff()) return 0.0;
    const double to_and_fro = reflected * facing_factor(common.x(), common.y(), sum);
    return to_and_fro < least_to_and_fro ? 0.0 : sum;
}

bool are_same(const Segment& a, const Segment& b, double reach) {
    const auto near = [&](const Vec3& p, const Vec3& q) { return (p - q).norm() <= reach; };
    return (near(a[0], b[0]) && near(a[1], b[1])) || (near(a[0], b[1]) && near(a[1], b[0]));
}

/// Outline of `other` on the plane of `s`.
void project(const Surface& s, const Surface& other, double height, double reach,
             std::vector<GapLine>& lines) {
    const auto foot = [&](const Vec3& p) {
        return Vec3(p - (p - s.corners[0]).dot(s.normal) * s.normal);
    };
    const std::size_t n = other.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Segment edge{foot(other.corners[k]), foot(other.corners[(k + 1) % n])};
        const auto shared = std::find_if(lines.begin(), lines.end(), [&](const GapLine& line) {
            return are_same(line.at, edge, reach);
        });
        if (shared != lines.end())
            lines.erase(shared);
        else
            lines.push_back({edge, height});
    }
}

}  // namespace

std::vector<std::vector<GapLine>> find_gap_lines(const Scene& scene) {
    const LocalTolerance tolerance(scene);
    double area = 0.0;
    for (const Surface& s : scene.surfaces) area += s.coarseness == 1.0 ? s.area : 0.0;
    std::vector<SurfaceIndex> large;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        if (scene.surfaces[s].coarseness == 1.0 && scene.surfaces[s].area > least_of_area * area)
            large.push_back(s);
    std::vector<std::vector<GapLine>> lines(scene.surfaces.size());
    for (const SurfaceIndex s : large) {
        const double reach = tolerance.at(s);
        for (const SurfaceIndex other : large) {
            const Surface &below = scene.surfaces[s], &above = scene.surfaces[other];
            const double height = height_of_gap(scene, below, above, reach);
            if (height > 0.0 && height_of_gap(scene, above, below, tolerance.at(other)) > 0.0)
                project(below, above, height, reach, lines[s]);
        }
        std::erase_if(lines[s], [&](const GapLine& line) {
            return !reaches_inside(scene.surfaces[s], line.at, reach);
        });
    }
    return lines;
}

}  // namespace patchlight
