#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"
#include "tests/server/scene_texts.h"

#include <numbers>

namespace patchlight::server::file_objects_test {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// thing.obj with a red square, a square of a material that nothing defines and one of none.
void write_thing() {
    write_test_file("thing.mtl", "newmtl red\nKd 0.6 0.1 0.1\nKe 2 0 0\n");
    write_test_file("thing.obj", "mtllib thing.mtl\n" + square +
                                     "f 1 2 3 4\ng a\nusemtl red\nf 1 2 3 4\n"
                                     "g b\nusemtl lost\nf 1 2 3 4\n");
}

const Material& material(const Job& job, std::size_t surface) {
    return job.scene.materials.at(job.scene.surfaces.at(surface).material);
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> listed;
    for (const Object& object : scene.objects) listed.push_back(object.name);
    return listed;
}

void expect_beside_rejected(const std::string& scene, const std::string& pointer,
                            const std::string& detail) {
    try {
        read_beside(scene);
        ADD_FAILURE() << "accepted: " << scene;
    } catch (const InputError& error) {
        EXPECT_EQ(error.pointer(), pointer);
        EXPECT_EQ(std::string(error.what()).substr(0, detail.size()), detail);
    }
}

TEST(FileObjects, GroupsAreObjectsBelow) {
    write_thing();
    EXPECT_EQ(names(scene_of_file("thing.obj").scene),
              (std::vector<std::string>{"thing", "thing/a", "thing/b"}));
}

TEST(FileObjects, TheObjectsOwnMaterialComesFirst) {
    write_thing();
    const std::string blocks = R"("materials": {"paint": {"reflectance": 0.3}, "red": {}})";
    const Job job = scene_of_file("thing.obj", R"("material": "paint")", blocks);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(material(job, k).name, "paint");
    EXPECT_EQ(job.scene.materials.size(), 2u);
    EXPECT_TRUE(job.scene.findings.empty());
}

TEST(FileObjects, ThenTheScenesOfTheSameName) {
    write_thing();
    const std::string blocks =
        R"("materials": {"lost": {"reflectance": 0.2, "two_sided": true}, "red": {"reflectance": 0.3}})";
    const Job job = scene_of_file("thing.obj", "", blocks);
    EXPECT_EQ(material(job, 1).reflectance[0], 0.3);
    EXPECT_EQ(material(job, 1).exitance[0], 0.0);
    EXPECT_EQ(material(job, 2).name, "lost");
    EXPECT_EQ(job.scene.surfaces.size(), 4u);  // `lost` is two-sided
}

TEST(FileObjects, ThenTheFilesOwn) {
    write_thing();
    const Job job = scene_of_file("thing.obj");
    EXPECT_EQ(material(job, 1).name, "red");
    EXPECT_EQ(material(job, 1).reflectance[0], 0.6);
    EXPECT_DOUBLE_EQ(material(job, 1).exitance[0], 2 * std::numbers::pi);
}

TEST(FileObjects, AndThenOneHalfWhichIsAFinding) {
    write_thing();
    const Job job = scene_of_file("thing.obj");
    EXPECT_TRUE((material(job, 0).reflectance == 0.5).all());
    EXPECT_EQ(material(job, 0).name, "default");
    EXPECT_TRUE((material(job, 2).reflectance == 0.5).all());
    EXPECT_EQ(material(job, 2).name, "lost");
    const auto found = findings_of(job.scene, "default-material");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].objects, std::vector<std::string>{"thing"});
    EXPECT_EQ(found[0].detail, "faces of thing.obj without a material are taken to reflect 0.5");
    EXPECT_NE(found[1].detail.find(": 'lost'"), std::string::npos) << found[1].detail;
}

TEST(FileObjects, AReflectanceOfOneIsReadAsLessAndIsAFinding) {
    write_test_file("w.mtl", "newmtl white\nKd 1 0.5 7\n");
    write_test_file("w.obj", "mtllib w.mtl\nusemtl white\n" + square + "f 1 2 3 4\n");
    const Job job = scene_of_file("w.obj");
    EXPECT_TRUE((material(job, 0).reflectance == Rgb(0.99, 0.5, 0.99)).all());
    ASSERT_EQ(findings_of(job.scene, "reflectance-clamped").size(), 1u);
}

TEST(FileObjects, WhatIsLeftOutIsAFindingUnlessItIsRepainted) {
    write_test_file("t.mtl", "newmtl wood\nKd 0.5 0.5 0.5\nmap_Kd w.png\nd 0.5\n");
    write_test_file("t.obj", "mtllib t.mtl gone.mtl\nusemtl wood\n" + square + "f 1 2 3 4\n");
    const Scene plain = scene_of_file("t.obj").scene;
    for (const char* kind : {"texture-ignored", "transparency-ignored", "missing-material-file"})
        EXPECT_EQ(findings_of(plain, kind).size(), 1u) << kind;
    const std::string blocks = R"("materials": {"paint": {}})";
    EXPECT_TRUE(scene_of_file("t.obj", R"("material": "paint")", blocks).scene.findings.empty());
}

TEST(FileObjects, FacesWithoutAreaAreCounted) {
    write_test_file("z.obj", square + "f 1 2 3\nf 1 2 2\nf 1 1 1\n");
    const Scene scene = scene_of_file("z.obj").scene;
    EXPECT_EQ(scene.surfaces.size(), 1u);
    ASSERT_EQ(findings_of(scene, "degenerate-dropped").size(), 1u);
    EXPECT_EQ(findings_of(scene, "degenerate-dropped")[0].count, 2u);
}

TEST(FileObjects, TwoFilesMayHaveMaterialsOfOneName) {
    write_test_file("1.mtl", "newmtl m\nKd 0.1 0.1 0.1\n");
    write_test_file("2.mtl", "newmtl m\nKd 0.2 0.2 0.2\n");
    for (const char* k : {"1", "2"})
        write_test_file(std::string(k) + ".obj",
                        "mtllib " + std::string(k) + ".mtl\nusemtl m\n" + square + "f 1 2 3 4\n");
    const Job job = read_beside(R"({"version": 1, "objects": [{"file": "1.obj"},
        {"file": "2.obj"}, {"file": "1.obj", "translation": [0, 0, 1]}]})");
    EXPECT_EQ(material(job, 0).name, "m");
    EXPECT_EQ(material(job, 1).name, "m#2");
    EXPECT_EQ(material(job, 1).reflectance[0], 0.2);
    EXPECT_EQ(material(job, 2).name, "m");
}

TEST(FileObjects, LengthsAreTheScenesButGltfIsInMetres) {
    write_thing();
    GltfDocument document;
    document.node({{"attributes", {{"POSITION", document.square()}}}, {"mode", 6}});
    write_test_file("metres.gltf", document.text());
    const std::string blocks = R"("units": {"length": "mm"})";
    EXPECT_NEAR(scene_of_file("thing.obj", "", blocks).scene.surfaces[0].area, 1e-6, 1e-18);
    const Scene metres =
        scene_of_file("metres.gltf", R"("translation": [2000, 0, 0])", blocks).scene;
    EXPECT_NEAR(metres.surfaces[0].area, 0.5, 1e-12);
    EXPECT_NEAR(metres.surfaces[0].corners[0].x(), 2.0, 1e-12);
}

TEST(FileObjects, AMirrorKeepsFronts) {
    write_thing();
    const Scene scene = scene_of_file("thing.obj", R"("scale": [-1, 1, 1])").scene;
    EXPECT_GT(scene.surfaces[0].normal.z(), 0.99);
}

TEST(FileObjects, ASceneWithoutAFileOfItsOwnHasNoFiles) {
    expect_rejected(scene_with_object(R"({"file": "thing.obj"})"), "/objects/0/file",
                    "is relative to the scene's own file");
}

TEST(FileObjects, MistakesInAFileAreToldWithBothPlaces) {
    const std::string scene = R"({"version": 1, "objects": [{"file": "bad.obj")";
    write_test_file("bad.obj", square + "f 1 2 9\n");
    expect_beside_rejected(scene + "}]}", "/objects/0/file", "bad.obj:5: vertex 9 does not exist");
    write_test_file("bad.obj", "v 0 0 0\nv 3 3 0\nv 3 0 0\nv 0 2 0\nf 1 2 3 4\n");
    expect_beside_rejected(scene + "}]}", "/objects/0/file", "bad.obj:5: the polygon touches or");
    write_test_file("bad.obj", square + "f 1 2 3 4\n");
    expect_beside_rejected(scene + R"(, "scale": 1e9, "translation": [1e9, 0, 0]}]})",
                           "/objects/0/file", "bad.obj:5: a corner lies at 2e+09 m");
    expect_beside_rejected(R"({"version": 1, "objects": [{"file": "none.glb"}]})",
                           "/objects/0/file", "none.glb: cannot be read: No such file");
    expect_beside_rejected(R"({"version": 1, "objects": [{"file": 7}]})", "/objects/0/file",
                           "must be a text");
}

TEST(FileObjects, AGroupMayNotTakeTheNameOfAnObject) {
    write_thing();
    expect_beside_rejected(R"({"version": 1, "materials": {"w": {}}, "objects": [
        {"name": "thing/a", "material": "w", "polygon": [[0,0,0],[1,0,0],[0,1,0]]},
        {"name": "thing", "file": "thing.obj"}]})",
                           "/objects/1/file", "the name 'thing/a' is given twice");
}

}  // namespace
}  // namespace patchlight::server::file_objects_test
