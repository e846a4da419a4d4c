#include "solver/display/point_gather.h"
#include "solver/form_factors/point_factor.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::aperture_gather_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
constexpr int slits = 4;
constexpr double width = 0.01, plate_at = 0.5;

double slit_at(int k) { return 0.1 + 0.25 * k; }  // where it begins along x [m]

/// A floor, a lamp of 1 m x 1 m a metre above it, and a plate with slits half way.
Scene behind_slits() {
    Scene scene = empty_scene();
    add(scene, rectangle({-2, -2, 0}, 5 * x, 5 * y));
    add(scene, rectangle({0, 1, 1}, x, -y), lamp);
    double from = -4.0;
    for (int k = 0; k <= slits; ++k) {
        const double to = k < slits ? slit_at(k) : 5.0;
        add(scene, rectangle({from, -4, plate_at}, (to - from) * x, 9 * y), two_sided);
        from = to + width;
    }
    return scene;
}

struct Plate {
    CutScene pieces;
    RayScene rays;
    std::vector<LightSource> sources;

    Plate()
        : pieces(cut(behind_slits(), 9.0)),
          rays(pieces.scene, pieces.lines.overlaps),
          sources(find_light_sources(pieces.scene, pieces.lines, rays, 10)) {}
    /// Each slit in so many pieces, as far as the lamp can be seen through it.
    PointGather gather(int parts) const {
        std::vector<Aperture> found;
        for (int k = 0; k < slits; ++k)
            for (int part = 0; part < parts; ++part) {
                const double low = -0.5 + 2.0 * part / parts,
                             high = -0.5 + 2.0 * (part + 1) / parts;
                const RayPoint corner = rays.to_ray_space({slit_at(k), low, plate_at}),
                               first = rays.to_ray_space({slit_at(k) + width, low, plate_at}),
                               second = rays.to_ray_space({slit_at(k), high, plate_at});
                found.push_back(make_aperture(corner, first - corner, second - corner));
            }
        return {rays, sources, 1 << 14, found};
    }
};

/// By Lambert's formula, of what of the lamp lies behind each slit.
double exact(const Vec3& at) {
    double sum = 0.0;
    for (int k = 0; k < slits; ++k) {
        const double times = 1.0 / plate_at;  // the lamp's height over the plate's
        const double low = std::max(0.0, at.x() + times * (slit_at(k) - at.x())),
                     high = std::min(1.0, at.x() + times * (slit_at(k) + width - at.x()));
        if (!(high > low)) continue;
        ConvexPolygon seen;
        for (const Vec3& p : {Vec3(low, 1, 1), Vec3(high, 1, 1), Vec3(high, 0, 1), Vec3(low, 0, 1)})
            seen.add(p);
        sum += point_factor(at, z, seen, -z);
    }
    return sum;
}

class ApertureGather : public testing::TestWithParam<int> {};

TEST_P(ApertureGather, ShowsOfALampWhatSlitsLeaveOfIt) {
    const Plate plate;
    const PointGather gather = plate.gather(GetParam());
    DirectEffort effort{16, 1024};
    int lit = 0;
    for (int k = 0; k < 60; ++k) {
        const Vec3 at(-1.0 + 0.05 * k, 0.1 + 0.01 * k, 0.0);
        const double expected = exact(at);
        const auto found = gather.direct(gather.at(at, z, plate.rays.contact(), 0), effort,
                                         static_cast<std::uint64_t>(k));
        // 4 standard errors of 60 points: a false alarm in 300 runs, and the seeds are fixed.
        EXPECT_NEAR(found.irradiance[0], expected, 4.0 * std::sqrt(found.variance) + 1e-9)
            << at.transpose();
        EXPECT_NEAR(found.irradiance[0], expected, 0.1 * expected + 1e-9) << at.transpose();
        lit += expected > 0.0;
    }
    EXPECT_GT(lit, 30);
}

/// Whole slits are sampled one by one, their pieces all together.
INSTANTIATE_TEST_SUITE_P(Each, ApertureGather, testing::Values(1, 40));

TEST(ApertureGatherEffort, LeavesOutWhatIsOfNoMatter) {
    const Plate plate;
    const PointGather gather = plate.gather(1);
    DirectEffort effort{16, 1024};
    const GatherPoint point = gather.at({0.3, 0.5, 0}, z, plate.rays.contact(), 0);
    EXPECT_GT(gather.direct(point, effort, 1).irradiance[0], 0.0);
    effort.enough = 100.0;
    EXPECT_EQ(gather.direct(point, effort, 1).irradiance[0], 0.0);
}

}  // namespace
}  // namespace patchlight::aperture_gather_test
