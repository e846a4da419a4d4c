#include "solver/display/fill_unknown.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::fill_unknown_test {
namespace {

/// The room's light, alike on each wall, known at every `step`-th vertex.
struct Fixture {
    explicit Fixture(std::uint32_t step) {
        for (std::uint32_t v = 0; v < tree.vertices().size(); ++v) {
            known.push_back(step > 0 && v % step == 0);
            values.push_back(known[v] ? light(v) : Rgb::Zero());
        }
    }
    Rgb light(std::uint32_t v) const {
        const Surface& surface =
            pieces.scene.surfaces[pieces.mesh.patches[tree.vertices()[v].patch].surface];
        return Rgb::Constant(3.0 + surface.normal.dot(Vec3(1.0, 0.5, 0.2)));
    }
    double worst() const {
        double worst = 0.0;
        for (std::uint32_t v = 0; v < values.size(); ++v)
            worst = std::max(worst, std::abs((values[v] - light(v))[0]));
        return worst;
    }

    CutScene pieces = cut(room(), 0.1);
    RefinementTree tree{pieces.mesh,
                        find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene))};
    std::vector<bool> known;
    std::vector<Rgb> values;
};

TEST(FillUnknown, TakesTheMeanOfWhatFacesAlike) {
    Fixture some(7);
    fill_unknown(some.pieces.scene, some.pieces.mesh, some.tree, some.known, {}, some.values);
    EXPECT_LT(some.worst(), 1e-12);
}

TEST(FillUnknown, TakesTheGuessWhereNothingIsKnown) {
    Fixture none(0);
    const std::vector<Rgb> guess(none.pieces.mesh.size(), Rgb::Constant(2.5));
    fill_unknown(none.pieces.scene, none.pieces.mesh, none.tree, none.known, guess, none.values);
    for (const Rgb& value : none.values) EXPECT_EQ(value[0], 2.5);
}

}  // namespace
}  // namespace patchlight::fill_unknown_test
