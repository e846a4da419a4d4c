#include "tests/server/scene_texts.h"

#include <algorithm>
#include <numbers>

namespace patchlight::server::objects_json_test {
namespace {

const std::string unit_square = R"("polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]])";

Scene scene_of(const std::string& objects) {
    return read_scene_text(scene_with("objects", objects)).scene;
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> listed;
    for (const Object& object : scene.objects) listed.push_back(object.name);
    return listed;
}

/// The unit square under a transform given as JSON members.
Surface square_under(const std::string& transform) {
    return scene_of(R"([{"material": "white", )" + unit_square + ", " + transform + "}]")
        .surfaces.at(0);
}

void expect_near(const Vec3& point, const Vec3& wanted) {
    EXPECT_LT((point - wanted).norm(), 1e-12) << point.transpose();  // rounding of a few products
}

TEST(ObjectsJson, APolygonIsReadAsGiven) {
    const Scene scene =
        scene_of(R"([{"name": "floor", "material": "white", )" + unit_square + "}]");
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(names(scene), std::vector<std::string>{"floor"});
    EXPECT_EQ(scene.surfaces[0].area, 1.0);
    expect_near(scene.surfaces[0].normal, Vec3::UnitZ());
    expect_near(scene.surfaces[0].corners.at(2), Vec3(1, 1, 0));
}

TEST(ObjectsJson, LengthsAreConvertedToMetres) {
    for (const auto& [unit, metres] :
         {std::pair{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}) {
        const std::string units = std::string(R"({"length": ")") + unit + "\"}";
        const Job job = read_scene_text(scene_with("units", units));
        EXPECT_NEAR(job.scene.surfaces[0].area, metres * metres, 1e-12) << unit;
    }
}

TEST(ObjectsJson, AMeshNumbersItsFaces) {
    const Scene scene = scene_of(R"([{"material": "white", "mesh": {
        "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,0]],
        "faces": [[0,1,2,3],[1,4,5]]}}])");
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[1].face, 1u);
    EXPECT_EQ(scene.surfaces[1].corners.size(), 3u);
    EXPECT_EQ(scene.surfaces[1].object, 0u);
}

TEST(ObjectsJson, NamesArePathsAndTheUnnamedGetTheirNumber) {
    const Scene scene = scene_of(R"([
        {"name": "chairs", "material": "white", "children": [
            {"name": "chair-1", "children": [{)" +
                                 unit_square + R"(}, {"name": "back", )" + unit_square + R"(}]},
            {)" + unit_square + R"(}]},
        {"material": "white", )" +
                                 unit_square + "}]");
    EXPECT_EQ(names(scene), (std::vector<std::string>{"chairs/chair-1/#0", "chairs/chair-1/back",
                                                      "chairs/#1", "#1"}));
}

TEST(ObjectsJson, TheNearestMaterialAboveCounts) {
    const std::string scene = R"({"version": 1, "materials": {"a": {}, "b": {}}, "objects": [
        {"material": "a", "children": [{)" +
                              unit_square + R"(}, {"material": "b", )" + unit_square + "}]}]}";
    const Job job = read_scene_text(scene);
    EXPECT_EQ(job.scene.materials[job.scene.surfaces[0].material].name, "a");
    EXPECT_EQ(job.scene.materials[job.scene.surfaces[1].material].name, "b");
}

TEST(ObjectsJson, ScaleComesBeforeRotationBeforeTranslation) {
    // A quarter turn about z takes x to y.
    const Surface square = square_under(
        R"("translation": [10,20,30], "rotation": [0,0,0.7071067811865476,0.7071067811865476],
           "scale": [2,3,4])");
    expect_near(square.corners[1], Vec3(10, 22, 30));
    expect_near(square.corners[3], Vec3(7, 20, 30));
    EXPECT_NEAR(square.area, 6.0, 1e-12);
}

TEST(ObjectsJson, AMatrixIsColumnMajor) {
    const Surface square = square_under(R"("matrix": [0,2,0,0, -3,0,0,0, 0,0,4,0, 10,20,30,1])");
    expect_near(square.corners[1], Vec3(10, 22, 30));
    expect_near(square.corners[3], Vec3(7, 20, 30));
}

TEST(ObjectsJson, TransformsOfChildrenAreInTheirParents) {
    const Scene scene = scene_of(R"([{"material": "white", "translation": [5,0,0], "scale": 2,
        "children": [{"translation": [1,0,0], )" +
                                 unit_square + "}]}]");
    expect_near(scene.surfaces[0].corners[0], Vec3(7, 0, 0));
    EXPECT_NEAR(scene.surfaces[0].area, 4.0, 1e-12);
}

TEST(ObjectsJson, TranslationsAreInTheUnitOfTheScene) {
    nlohmann::json scene = nlohmann::json::parse(scene_with("units", R"({"length": "cm"})"));
    scene["objects"][0]["translation"] = {100, 0, 0};
    expect_near(read_scene_text(scene.dump()).scene.surfaces[0].corners[0], Vec3(1, 0, 0));
}

TEST(ObjectsJson, AMirroringTransformKeepsFrontsFronts) {
    // The front of the square looks along +z; a mirror in x leaves it so, one in z turns it.
    expect_near(square_under(R"("scale": [-1,1,1])").normal, Vec3::UnitZ());
    expect_near(square_under(R"("scale": [1,1,-1])").normal, -Vec3::UnitZ());
    expect_near(square_under(R"("scale": -1)").normal, -Vec3::UnitZ());
    expect_near(square_under(R"("matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])").normal,
                Vec3::UnitZ());
    // Two mirrors make none.
    const Scene scene = scene_of(R"([{"material": "white", "scale": [-1,1,1], "children": [
        {"scale": [1,-1,1], )" + unit_square +
                                 "}]}]");
    expect_near(scene.surfaces[0].normal, Vec3::UnitZ());
}

TEST(ObjectsJson, AMirroredQuadOffItsPlaneIsCutAlongTheSameDiagonal) {
    const auto shared_corners = [](const std::string& scale) {
        const Scene scene = scene_of(R"([{"material": "white", "scale": )" + scale + R"(,
            "polygon": [[0,0,0],[1,0,0],[1,1,0.1],[0,1,0]]}])");
        EXPECT_EQ(scene.surfaces.size(), 2u);
        double height = 0;  // of the corners both triangles have
        for (const Vec3& corner : scene.surfaces.at(0).corners)
            for (const Vec3& other : scene.surfaces.at(1).corners)
                if (corner == other) height += corner.z();
        return height;
    };
    EXPECT_NEAR(shared_corners("[1,1,1]"), 0.1, 1e-12);  // corners 0 and 2
    EXPECT_NEAR(shared_corners("[-1,1,1]"), 0.1, 1e-12);
}

TEST(ObjectsJson, ATwoSidedPolygonIsTwoSurfaces) {
    const Job job = read_scene_text(
        scene_with("materials", R"({"white": {"reflectance": 0.5, "two_sided": true}})"));
    ASSERT_EQ(job.scene.surfaces.size(), 2u);
    EXPECT_EQ(job.scene.surfaces[1].side, Side::back);
}

TEST(ObjectsJson, WithoutAnyAreaThereIsNoScene) {
    expect_rejected(
        scene_with_object(R"({"material": "white", "polygon": [[0,0,0],[1,0,0],[2,0,0]]})"),
        "/objects", "has an area");
}

TEST(ObjectsJson, OnePolygonWithoutAreaIsAFinding) {
    const Scene scene = scene_of(R"([{"material": "white", )" + unit_square + R"(},
        {"material": "white", "polygon": [[0,0,0],[1,0,0],[2,0,0]]}])");
    ASSERT_EQ(scene.findings.size(), 1u);
    EXPECT_EQ(scene.findings[0].kind, "degenerate-dropped");
}

}  // namespace
}  // namespace patchlight::server::objects_json_test
