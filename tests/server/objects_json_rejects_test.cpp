#include "tests/server/scene_texts.h"

namespace patchlight::server::objects_json_rejects_test {
namespace {

const std::string unit_square = R"("polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]])";

/// A white object with these members is refused at `pointer` below it.
void expect_object_rejected(const std::string& members, const std::string& pointer,
                            const std::string& words = "") {
    expect_rejected(scene_with_object(R"({"material": "white", )" + members + "}"),
                    "/objects/0" + pointer, words);
}

void expect_square_rejected(const std::string& members, const std::string& pointer,
                            const std::string& words = "") {
    expect_object_rejected(unit_square + ", " + members, pointer, words);
}

void expect_faces_rejected(const std::string& faces, const std::string& pointer,
                           const std::string& words = "") {
    expect_object_rejected(
        R"("mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0]], "faces": )" + faces + "}",
        "/mesh/faces" + pointer, words);
}

TEST(ObjectsJson, TheListIsAListAndNotEmpty) {
    expect_rejected(scene_with("objects", "[]"), "/objects", "at least one object");
    expect_rejected(scene_with("objects", "{}"), "/objects", "must be an array, not an object");
    expect_rejected(scene_with("objects", "null"), "/objects", "not null");
    expect_rejected(scene_with_object("7"), "/objects/0", "must be an object, not a number");
    expect_object_rejected(R"("children": [])", "/children", "at least one object");
}

TEST(ObjectsJson, AnObjectCarriesExactlyOneContent) {
    expect_rejected(scene_with_object(R"({"material": "white"})"), "/objects/0", "needs one of");
    expect_square_rejected(R"("children": [])", "", "exactly one");
    expect_square_rejected(R"("mesh": {})", "", "exactly one");
}

TEST(ObjectsJson, UnknownKeysOfAnObjectAreRefused) {
    expect_square_rejected(R"("translate": [0,0,0])", "/translate", "did you mean 'translation'?");
    expect_square_rejected(R"("Material": "white")", "/Material", "did you mean 'material'?");
    expect_square_rejected(R"("polgon": [])", "/polgon", "did you mean 'polygon'?");
}

TEST(ObjectsJson, EveryPolygonNeedsAKnownMaterial) {
    expect_rejected(scene_with_object("{" + unit_square + "}"), "/objects/0", "'material'");
    expect_rejected(scene_with_object(R"({"material": "whit", )" + unit_square + "}"),
                    "/objects/0/material", "did you mean 'white'?");
    expect_rejected(scene_with_object(R"({"material": 3, )" + unit_square + "}"),
                    "/objects/0/material", "must be a text");
    expect_rejected(R"({"version": 1, "objects": [{)" + unit_square + "}]}", "/objects/0");
}

TEST(ObjectsJson, CornersAreThreeFiniteNumbersInReach) {
    expect_object_rejected(R"("polygon": [[0,0,0],[1,0,0]])", "/polygon", "at least 3 corners");
    expect_object_rejected(R"("polygon": 7)", "/polygon", "must be an array");
    expect_object_rejected(R"("polygon": [[0,0,0],[1,0,0],null])", "/polygon/2", "not null");
    expect_object_rejected(R"("polygon": [[0,0,0],[1,0,0],"c"])", "/polygon/2", "not a text");
    expect_object_rejected(R"("polygon": [[0,0,0],[1,0],[1,1,0]])", "/polygon/1", "not 2");
    expect_object_rejected(R"("polygon": [[0,0,0],[1,0,null],[1,1,0]])", "/polygon/1/2");
    expect_object_rejected(R"("polygon": [[0,0,0],[1e30,0,0],[1,1,0]])", "/polygon/1/0", "1e+15");
    expect_object_rejected(R"("polygon": [[0,0,0],[1e10,0,0],[1,1,0]])", "/polygon/1", "1e9 m");
}

TEST(ObjectsJson, TransformsCannotThrowGeometryOutOfReach) {
    expect_square_rejected(R"("scale": 1e12)", "/scale");
    expect_square_rejected(R"("translation": [1e9,1,0], "scale": 2)", "/polygon/1", "1e9 m");
    expect_object_rejected(R"("scale": 1e9, "children": [{"scale": 1e9, )" + unit_square + "}]",
                           "/children/0/polygon/1", "1e9 m");
}

TEST(ObjectsJson, APolygonThatCrossesItselfIsRefused) {
    expect_object_rejected(R"("polygon": [[0,0,0],[3,3,0],[3,0,0],[0,2,0]])", "/polygon");
}

TEST(ObjectsJson, FacesReferToVerticesThatExist) {
    expect_faces_rejected("[[0,1,99]]", "/0/2", "vertex 99 does not exist; there are 3");
    expect_faces_rejected("[[0,1,2],[0,1,-1]]", "/1/2", "vertex -1 does not exist");
    expect_faces_rejected("[[0,1,1.5]]", "/0/2", "whole number, not 1.5");
    expect_faces_rejected("[[0,1,1e300]]", "/0/2");
    expect_faces_rejected("[[0,1,\"2\"]]", "/0/2", "must be a number");
    expect_faces_rejected("[[0,1,true]]", "/0/2", "must be a number");
    expect_faces_rejected("[[0,1]]", "/0", "at least 3 corners");
    expect_faces_rejected("[[0,1,2,1]]", "/0", "vertex 1 is used twice");
    expect_faces_rejected("[]", "", "at least one face");
    expect_faces_rejected("7", "", "must be an array");
}

TEST(ObjectsJson, AMeshNeedsVerticesAndFaces) {
    expect_object_rejected(R"("mesh": {"faces": [[0,1,2]]})", "/mesh", "needs 'vertices'");
    expect_object_rejected(R"("mesh": {"vertices": [[0,0,0]]})", "/mesh", "needs 'faces'");
    expect_object_rejected(R"("mesh": {"vertices": [], "faces": [], "normals": []})",
                           "/mesh/normals", "unknown key");
    expect_object_rejected(R"("mesh": {"vertices": [[0,0,1e30]], "faces": [[0,1,2]]})",
                           "/mesh/vertices/0/2");
    expect_object_rejected(R"("mesh": [])", "/mesh", "must be an object");
}

TEST(ObjectsJson, TransformsAreChecked) {
    expect_square_rejected(R"("scale": 0)", "/scale", "must not be 0");
    expect_square_rejected(R"("scale": [1,0,1])", "/scale", "must not be 0");
    expect_square_rejected(R"("scale": [1,1])", "/scale", "3 numbers, not 2");
    expect_square_rejected(R"("rotation": [0,0,0])", "/rotation", "4 numbers");
    expect_square_rejected(R"("rotation": [0,0,0,2])", "/rotation", "its length is 2");
    expect_square_rejected(R"("rotation": [0,0,0,0])", "/rotation", "unit quaternion");
    expect_square_rejected(R"("translation": 3)", "/translation", "must be an array");
    expect_square_rejected(R"("matrix": [1,0,0,0])", "/matrix", "16 numbers");
    expect_square_rejected(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2])", "/matrix",
                           "last row");
    expect_square_rejected(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,0,0, 0,0,0,1])", "/matrix",
                           "flatten");
    expect_square_rejected(R"("scale": 1, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])",
                           "/matrix", "either");
}

TEST(ObjectsJson, ARotationNeedNotBeExact) {
    EXPECT_NO_THROW(read_scene_text(scene_with_object(
        R"({"material": "white", "rotation": [0,0,0.707,0.707], )" + unit_square + "}")));
}

TEST(ObjectsJson, NamesAreGivenOnce) {
    const std::string square = R"({"name": "a", "material": "white", )" + unit_square + "}";
    expect_rejected(scene_with("objects", "[" + square + "," + square + "]"), "/objects/1/name",
                    "'a' is given twice");
    expect_rejected(scene_with_object(R"({"name": "g", "material": "white", "children": [)" +
                                      square + "," + square + "]}"),
                    "/objects/0/children/1/name", "'g/a' is given twice");
    expect_square_rejected(R"("name": "")", "/name", "empty");
    expect_square_rejected(R"("name": "a\u0000b")", "/name", "control characters");
    expect_square_rejected(R"("name": 5)", "/name", "must be a text");
    expect_square_rejected(R"("name": ")" + std::string(257, 'n') + "\"", "/name", "limit is 256");
}

}  // namespace
}  // namespace patchlight::server::objects_json_rejects_test
