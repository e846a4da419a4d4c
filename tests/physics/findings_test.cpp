#include "solver/solve_scene.h"
#include "tests/physics/random_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::findings_test {
namespace {

// Boxes of random rooms stand on common ground, and some hang in mid-air, perhaps just above
// others: both are so, and told.
bool may_be_true(const Finding& finding) {
    return finding.kind == "coplanar-overlap" || finding.kind == "floating-object";
}

TEST(Findings, OfRandomRoomsAreNoFalseAlarms) {
    for (unsigned seed = 0; seed < 60; ++seed)  // every third lacks a wall
        for (const Finding& finding : find_flaws(random_room(seed), {}))
            EXPECT_TRUE(may_be_true(finding))
                << seed << ": " << finding.kind << ": " << finding.detail;
}

TEST(Findings, TellEveryWallThatStandsOffTheOthers) {
    for (unsigned seed = 1; seed < 60; seed += 3) {
        Scene scene = random_room(seed);
        Surface& wall = scene.surfaces[seed % 6];  // the room is the first object
        const double share = std::pow(10.0, -5.3 + 3.2 * (seed / 60.0));  // up to 8e-3
        const double off = share * scene_size(scene);
        for (Vec3& p : wall.corners) p -= off * wall.normal;
        const std::vector<Finding> findings = find_flaws(scene, {});
        EXPECT_TRUE(
            std::any_of(findings.begin(), findings.end(),
                        [](const Finding& finding) { return finding.kind == "light-leak"; }))
            << seed << ", share of the size: " << share;
    }
}

}  // namespace
}  // namespace patchlight::findings_test
