#include "server/input_errors.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"
#include "tests/server/scene_texts.h"

namespace patchlight::server::instances_test {
namespace {

const std::string tile = R"("polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]])";

/// A scene with materials `a` and `b`.
std::string scene(const std::string& definitions, const std::string& objects) {
    return R"({"version": 1, "materials": {"a": {"reflectance": 0.1}, "b": {"reflectance": 0.2}},
        "definitions": )" +
           definitions + R"(, "objects": )" + objects + "}";
}

Scene read(const std::string& definitions, const std::string& objects) {
    return read_scene_text(scene(definitions, objects)).scene;
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> listed;
    for (const Object& object : scene.objects) listed.push_back(object.name);
    return listed;
}

TEST(Instances, PutADefinitionInPlaceWithBothTransforms) {
    const Scene placed =
        read(R"({"tile": {"scale": 2, )" + tile + "}}",
             R"([{"name": "t", "material": "a", "instance": "tile", "translation": [5, 0, 0]}])");
    EXPECT_EQ(names(placed), std::vector<std::string>{"t"});
    EXPECT_EQ(placed.surfaces[0].corners[1], Vec3(7, 0, 0));
}

TEST(Instances, ChildrenOfADefinitionAreBelowTheInstance) {
    const Scene placed = read(
        R"({"pair": {"material": "a", "children": [{"name": "x", )" + tile + "}, {" + tile + "}]}}",
        R"([{"name": "p", "instance": "pair"}, {"instance": "pair"}])");
    EXPECT_EQ(names(placed), (std::vector<std::string>{"p/x", "p/#1", "#1/x", "#1/#1"}));
}

TEST(Instances, MayBeInsideDefinitions) {
    const Scene placed =
        read(R"({"tile": {)" + tile + R"(},
            "row": {"children": [{"instance": "tile"}, {"instance": "tile", "translation": [2,0,0]}]},
            "field": {"children": [{"instance": "row"}, {"instance": "row", "translation": [0,2,0]}]}})",
             R"([{"name": "f", "material": "a", "instance": "field", "translation": [0,0,3]}])");
    ASSERT_EQ(placed.surfaces.size(), 4u);
    EXPECT_EQ(placed.surfaces[3].corners[0], Vec3(2, 2, 3));
    EXPECT_EQ(placed.objects[3].name, "f/#1/#1");
}

TEST(Instances, TheNearestMaterialIsTheDefinitionsOwn) {
    const auto reflectance = [](const std::string& definition, const std::string& object) {
        const Scene placed = read(R"({"tile": {)" + definition + tile + "}}", "[" + object + "]");
        return placed.materials[placed.surfaces[0].material].reflectance[0];
    };
    EXPECT_EQ(reflectance(R"("material": "b", )", R"({"material": "a", "instance": "tile"})"), 0.2);
    EXPECT_EQ(reflectance("", R"({"material": "a", "instance": "tile"})"), 0.1);
    EXPECT_EQ(reflectance("", R"({"material": "a", "children": [{"instance": "tile"}]})"), 0.1);
    expect_rejected(scene(R"({"tile": {)" + tile + "}}", R"([{"instance": "tile"}])"),
                    "/definitions/tile", "needs a 'material'");
}

TEST(Instances, AMirrorKeepsFronts) {
    const Scene placed = read(R"({"tile": {"scale": [1, -1, 1], )" + tile + "}}",
                              R"([{"material": "a", "instance": "tile", "scale": [1, 1, -1]},
                                  {"material": "a", "instance": "tile", "translation": [3, 0, 0]}])");
    EXPECT_LT(placed.surfaces[0].normal.z(), -0.99);
    EXPECT_GT(placed.surfaces[1].normal.z(), 0.99);
}

TEST(Instances, ADefinitionMayBeAFile) {
    write_test_file("tile.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng half\nf 1 2 3\n");
    const Job job = read_beside(R"({"version": 1, "definitions": {"tile": {"file": "tile.obj"}},
        "objects": [{"name": "a", "instance": "tile"},
                    {"name": "b", "instance": "tile", "translation": [0, 0, 2]}]})");
    EXPECT_EQ(names(job.scene), (std::vector<std::string>{"a/half", "b/half"}));
    EXPECT_EQ(job.scene.materials.size(), 1u);
    EXPECT_EQ(job.scene.findings.size(), 1u);  // one file, one finding
}

TEST(Instances, ReferToDefinitionsThatAreThere) {
    expect_rejected(
        scene(R"({"tile": {"material": "a", )" + tile + "}}", R"([{"instance": "tyle"}])"),
        "/objects/0/instance", "no definition 'tyle'; did you mean 'tile'?");
    expect_rejected(scene("{}", R"([{"instance": 7}])"), "/objects/0/instance", "must be a text");
    expect_rejected(scene("[]", R"([{"material": "a", )" + tile + "}]"), "/definitions",
                    "must be an object");
}

TEST(Instances, OfThemselvesAreRefused) {
    expect_rejected(scene(R"({"x": {"instance": "x"}})", R"([{"instance": "x"}])"),
                    "/definitions/x/instance", "'x' contains itself");
    expect_rejected(scene(R"({"x": {"children": [{"instance": "y"}]}, "y": {"instance": "x"}})",
                          R"([{"instance": "x"}])"),
                    "/definitions/y/instance", "'x' contains itself");
}

TEST(Instances, BillionsOfPolygonsAreRefusedBeforeOneIsMade) {
    std::string definitions = R"({"d0": {"material": "a", )" + tile + "}";
    for (int k = 1; k <= 40; ++k) {
        const std::string below = R"({"instance": "d)" + std::to_string(k - 1) + "\"}";
        definitions +=
            R"(, "d)" + std::to_string(k) + R"(": {"children": [)" + below + "," + below + "]}";
    }
    expect_rejected(scene(definitions + "}", R"([{"instance": "d40"}])"), "/objects/0",
                    "more than 4000000 polygons");
}

TEST(Instances, ChainsAreNotEndless) {
    std::string definitions = R"({"d0": {"material": "a", )" + tile + "}";
    for (int k = 1; k <= 100; ++k)
        definitions +=
            R"(, "d)" + std::to_string(k) + R"(": {"instance": "d)" + std::to_string(k - 1) + "\"}";
    expect_rejected(scene(definitions + "}", R"([{"instance": "d100"}])"),
                    "/definitions/d37/instance", "more than 64 deep");
}

TEST(Instances, MistakesInADefinitionAreToldOnceAndWhereTheyStand) {
    const std::string wrong = R"({"tile": {"material": "a", "polygon": [[0,0,0],[1,0,0]]}})";
    try {
        read_scene_text(scene(wrong, R"([{"instance": "tile"}, {"instance": "tile"}])"));
        ADD_FAILURE();
    } catch (const InputErrors& errors) {
        ASSERT_EQ(errors.faults().size(), 1u);
        EXPECT_EQ(errors.pointer(), "/definitions/tile/polygon");
    }
    expect_rejected(scene(R"({"tile": {"name": "x", )" + tile + "}}", R"([{"instance": "tile"}])"),
                    "/definitions/tile/name", "unknown key");
}

TEST(Instances, UnusedDefinitionsAreReadAsWell) {
    const std::string objects = R"([{"material": "a", )" + tile + "}]";
    EXPECT_EQ(read(R"({"spare": {)" + tile + "}}", objects).surfaces.size(), 1u);
    expect_rejected(scene(R"({"spare": {"polygon": [[0,0,0],[1,0,0]]}})", objects),
                    "/definitions/spare/polygon", "at least 3 corners");
    expect_rejected(scene(R"({"spare": {"instance": "nothing"}})", objects),
                    "/definitions/spare/instance", "no definition 'nothing'");
    expect_rejected(scene(R"({"spare": {"children": [{"instance": "spare"}]}})", objects),
                    "/definitions/spare/children/0/instance", "contains itself");
    expect_rejected(scene(R"({"spare": 7})", objects), "/definitions/spare", "must be an object");
}

}  // namespace
}  // namespace patchlight::server::instances_test
