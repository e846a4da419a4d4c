#include "tests/bench/cornell_box.h"
#include "tests/solver/scenes.h"
#include "tests/stability/judgement.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::stability::scale_test {
namespace {

class Scale : public EveryColumn {};

/// Difference of object means, √(Σ A (a − b)²) over √(Σ A (b − E)²), as an accuracy is defined.
double difference(const Solution& a, const Solution& b) {
    double wrong = 0.0, whole = 0.0;
    for (std::size_t o = 0; o < b.objects.size(); ++o) {
        const double area = b.objects[o].area;
        const double emitted = luminance(b.objects[o].emitted) / area;
        const double there = luminance(a.objects[o].radiosity),
                     here = luminance(b.objects[o].radiosity);
        wrong += area * std::pow(there - here, 2);
        whole += area * std::pow(here - emitted, 2);
    }
    return std::sqrt(wrong / whole);
}

TEST_P(Scale, TheCornellBoxIsTheSameAtAnySizePlaceAndAngle) {
    constexpr double size = 0.56;  // of the box [m]
    const HandSet coarse{0.3 * size, 256, 1e-6};
    constexpr double same = 1e-4;  // where rays are laid out as before, rounding alone is left
    const Scene box = cornell_box();
    const Solution here = solve(box, GetParam(), coarse);
    const Vec3 far = 1e4 * size * Vec3(1, -2, 0.5).normalized();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(37.3 * std::numbers::pi / 180.0, Vec3(1, 2, 3).normalized())
            .toRotationMatrix();
    const std::vector<Motion> motions{{1e-4},
                                      {1e-2},
                                      {1e3},
                                      {1e6},
                                      {1.0, far},
                                      {1.0, Vec3::Zero(), turn},
                                      {1e6, 1e6 * far, turn}};
    double worst = 0.0, allowed = 0.0;
    for (const Motion& motion : motions) {
        HandSet scaled = coarse;
        scaled.patch_size *= motion.scale;
        const Solution there = solve(moved(box, motion), GetParam(), scaled);
        ASSERT_EQ(there.mesh.size(), here.mesh.size());
        ASSERT_TRUE(there.error.estimate && here.error.estimate);
        const double apart = difference(there, here);
        worst = std::max(worst, apart);
        allowed = std::max(allowed, *there.error.estimate + *here.error.estimate);
    }
    Excuse excuse;
    if (GetParam().to_accuracy)
        excuse = {allowed, "another sample of rays, within the sum of both estimates"};
    if (GetParam().draws())
        excuse = {allowed,
                  "hemicubes lie by the world's axes: cells are laid out anew when the box is "
                  "turned, within twice the error reported"};
    judge("C3", GetParam(), worst, same, excuse);
}

PATCHLIGHT_EVERY_COLUMN(Scale);

}  // namespace
}  // namespace patchlight::stability::scale_test
