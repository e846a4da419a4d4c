#include "solver/rays/patch_sampler.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::segment_ends_test {
namespace {

/// Lamps in a ceiling, as many as there may be: none is dark because rounding puts the end of a
/// segment behind it.
TEST(SegmentEnds, ASurfaceDoesNotHideItself) {
    for (const int side : {1, 3, 7, 9, 10, 16, 20, 24, 33}) {
        Scene scene = scene_of(rectangle({0, 0, 0}, Vec3(1, 0, 0), Vec3(0, 1, 0)));
        const double a = 1.0 / side;
        for (int k = 0; k < side * side; ++k)
            add(scene,
                rectangle({k % side * a, k / side * a + a, 1}, Vec3(a, 0, 0), Vec3(0, -a, 0)),
                lamp);
        const CutScene pieces = cut(scene, 2.0);
        const RayScene rays(pieces.scene, pieces.lines.overlaps);
        int dark = 0;
        for (PatchIndex i = 0; i < pieces.mesh.size(); ++i) {
            const SurfaceIndex s = pieces.mesh.patches[i].surface;
            if (s == 0) continue;
            const PatchSampler sampler =
                make_sampler(pieces.mesh, i, pieces.scene.surfaces[s].normal, rays);
            for (const Vec3& from : {Vec3(0.5, 0.5, 0), Vec3(0.01, 0.02, 0), Vec3(0.3, 0.8, 0)}) {
                const RayPoint origin = rays.to_ray_space(from) + rays.lift(0) * RayPoint(0, 0, 1),
                               goal = sampler.at(0.3f, 0.6f) + rays.lift(s) * sampler.normal;
                RayBatch batch;
                RayScene::set_segment(batch, 0, origin, 0, goal - origin, goal, 0);
                dark += static_cast<int>(rays.blocked(batch, 1));
            }
        }
        EXPECT_EQ(dark, 0) << side << " x " << side;
    }
}

}  // namespace
}  // namespace patchlight::segment_ends_test
