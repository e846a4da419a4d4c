#include "solver/findings/overlaps.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::overlaps_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

std::vector<Finding> told_of(const Scene& scene) {
    return overlap_findings(scene, find_coplanar_overlaps(scene));
}

Scene named(const std::vector<std::pair<Polygon, MaterialIndex>>& polygons) {
    Scene scene = empty_scene();
    for (const auto& [polygon, material] : polygons) add(scene, polygon, material);
    return scene;
}

const Polygon whole = rectangle(Vec3::Zero(), x, y), part = rectangle(0.2 * x, 0.5 * x, 0.5 * y);

TEST(OverlapFindings, OfARugOnAFloorAndALampOnACeilingAreNone) {
    EXPECT_TRUE(told_of(named({{whole, white}, {part, white}})).empty());
    EXPECT_TRUE(told_of(named({{whole, white}, {part, lamp}})).empty());
    EXPECT_TRUE(told_of(named({{whole, white}, {reversed(whole), white}})).empty());
}

TEST(OverlapFindings, TellOfALampThatIsCoveredInPart) {
    const std::vector<Finding> findings = told_of(named({{whole, lamp}, {part, white}}));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].kind, "coplanar-overlap");
    EXPECT_EQ(findings[0].objects, (std::vector<std::string>{"#1", "#0"}));
    EXPECT_NE(findings[0].detail.find("gives off nothing"), std::string::npos);
    EXPECT_NE(findings[0].detail.find("near (0.45, 0.25, 0) m"), std::string::npos);
}

TEST(OverlapFindings, TellOfAnObjectThatIsCoveredWhollyAlsoByTwo) {
    const Polygon left = rectangle(Vec3::Zero(), 0.6 * x, y),
                  right = rectangle(0.5 * x, 0.7 * x, y);
    const std::vector<Finding> findings =
        told_of(named({{whole, white}, {left, white}, {right, white}}));
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_NE(findings[0].detail.find("covers all of it"), std::string::npos);
}

TEST(OverlapFindings, TellOfAFaceGivenTwiceWhereverItsCornersBegin) {
    const Polygon turned{whole[2], whole[3], whole[0], whole[1]};
    const std::vector<Finding> findings = told_of(named({{whole, white}, {turned, white}}));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_NE(findings[0].detail.find("share a face"), std::string::npos);
}

TEST(OverlapFindings, CountPolygonsOfOnePairOfObjects) {
    Scene scene = empty_scene();
    scene.objects = {{"lamps"}, {"rugs"}};
    for (const MaterialIndex m : {lamp, white})
        for (const double at : {0.0, 0.4, 0.8})
            add_polygon(scene, m == lamp ? 0 : 1, m, 0, rectangle(at * x, 0.3 * x, 0.3 * y), "");
    const std::vector<Finding> findings = told_of(scene);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].count, 3u);
}

}  // namespace
}  // namespace patchlight::overlaps_test
