#include "server/json_document.h"
#include "tests/server/run_program.h"
#include "tests/server/scene_texts.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace patchlight::server::hints_test {
namespace {

void expect_material_hint(const std::string& members, const std::string& pointer,
                          const std::string& words) {
    expect_rejected(scene_with("materials", "{\"white\": {" + members + "}}"),
                    "/materials/white/" + pointer, words);
}

TEST(Hints, ATextThatIsANumberIsToldHowToBeOne) {
    expect_material_hint(R"("reflectance": "0.5")", "reflectance", "write 0.5 without quotes");
    expect_material_hint(R"("exitance": "50%")", "exitance", "write 0.5, without quotes and %");
    expect_material_hint(R"("exitance": [1, "2,5", 3])", "exitance/1", "write 2.5 without quotes");
    expect_material_hint(R"("exitance": [1, "20 W", 3])", "exitance/1", "write 20, without a unit");
    expect_material_hint(R"("two_sided": "true")", "two_sided", "write true without quotes");
    expect_material_hint(R"("two_sided": 1)", "two_sided", "write true");
    expect_rejected(scene_with("solve", R"({"accuracy": "1%"})"), "/solve/accuracy", "write 0.01");
}

TEST(Hints, PerCentAreToldAsShares) {
    expect_material_hint(R"("reflectance": 80)", "reflectance", "80 % is 0.8");
    expect_material_hint(R"("reflectance": [0.5, 65, 0.1])", "reflectance/1", "65 % is 0.65");
    expect_rejected(scene_with("solve", R"({"accuracy": 5})"), "/solve/accuracy", "5 % is 0.05");
    expect_rejected(scene_with("solve", R"({"tolerance": 5})"), "/solve/tolerance", "5 % is 0.05");
}

TEST(Hints, OtherWordsForAKeyAreKnown) {
    for (const char* word : {"albedo", "color", "colour", "diffuse", "Kd", "baseColor"})
        expect_material_hint("\"" + std::string(word) + "\": 0.5", word,
                             "did you mean 'reflectance'?");
    for (const char* word : {"emission", "emissive", "emittance"})
        expect_material_hint("\"" + std::string(word) + "\": 5", word, "did you mean 'exitance'?");
    expect_rejected(scene_with("cameras", R"([{"position": [0,0,1], "look_at": [0,0,0]}])"),
                    "/cameras/0/position", "did you mean 'eye'?");
    expect_rejected(scene_with("cameras", R"([{"eye": [0,0,1], "target": [0,0,0]}])"),
                    "/cameras/0/target", "did you mean 'look_at'?");
    expect_rejected(scene_with("units", R"({"length": "millimetres"})"), "/units/length",
                    "did you mean 'mm'?");
    expect_rejected(scene_with_object(R"({"material": "white", "vertices": []})"),
                    "/objects/0/vertices", "did you mean 'polygon'?");
}

TEST(Hints, AMissingVersionIsWrittenOut) {
    expect_rejected(R"({"objects": []})", "/objects", "");
    try {
        read_scene_text(R"({"materials": {"w": {}}, "objects": [{"material": "w",
                            "polygon": [[0,0,0],[1,0,0],[0,1,0]]}]})");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("\"version\": 1"), std::string::npos);
    }
}

TEST(Hints, FacesThatCountFromOneAreTold) {
    const auto mesh = [](const std::string& faces) {
        return scene_with_object(R"({"material": "white", "mesh": {"vertices":
            [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "faces": )" +
                                 faces + "}}");
    };
    expect_rejected(mesh("[[1,2,3],[1,3,4]]"), "/objects/0/mesh/faces/1/2", "count from 1");
    try {
        read_scene_text(mesh("[[0,2,3],[1,3,4]]"));
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find("count from 1"), std::string::npos);
    }
}

TEST(Hints, RotationsThatAreNoQuaternionAreTurnedIntoOne) {
    const auto expect_rotation_hint = [](const std::string& numbers, const std::string& words) {
        expect_rejected(scene_with_object(R"({"material": "white", "rotation": )" + numbers +
                                          R"(, "polygon": [[0,0,0],[1,0,0],[0,1,0]]})"),
                        "/objects/0/rotation", words);
    };
    expect_rotation_hint("[0,0,1,90]", "90° about that axis is [0, 0, 0.707107, 0.707107]");
    expect_rotation_hint("[90,0,0,1]", "90° about that axis is [0, 0, 0.707107, 0.707107]");
    expect_rotation_hint("[0,0,90,0]", "degrees are not read");
    expect_rotation_hint("[0,0,1,1]", "it is [0, 0, 0.707107, 0.707107]");
    expect_rotation_hint("[0,0,90]", "it is [0, 0, 0.707107, 0.707107]");
}

void expect_json_hint(const std::string& text, const std::string& words) {
    try {
        parse_json(text);
        ADD_FAILURE() << "accepted: " << text;
    } catch (const JsonError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
            << text << ": " << error.what();
    }
}

TEST(Hints, SlipsInJsonAreTold) {
    for (const char* lacking :
         {R"({"a": 1 "b": 2})", R"({"a": 1, "b": [1 2]})", R"([[0,0] [1,1]])", R"([{} {}])",
          R"({"a": "x" "b": 1})", R"([true false])", "{\"a\": 1\n\"b\": 2}", R"(["a" "b"])"})
        expect_json_hint(lacking, "a comma is missing");
    expect_json_hint(R"([1, 2,])", "no comma may stand before a closing bracket");
    expect_json_hint(R"({"a": 1,})", "no comma may stand before a closing bracket");
    expect_json_hint(R"({"a": [1, 2})", "");
    expect_json_hint(R"({"a": 1)", "ends too early");
    expect_json_hint("{\"a\": 1 // one\n}", "no comments");
    expect_json_hint("# a scene\n{}", "no comments");
    expect_json_hint("{'a': 1}", "double quotes");
    expect_json_hint("{a: 1}", "double quotes");
    expect_json_hint(R"({"a": True})", "small letters");
    expect_json_hint(R"({"a": NaN})", "finite");
    expect_json_hint(R"({"a" 1})", "colon");
}

TEST(Hints, AnOptionIsNotTakenForTheNameOfAFile) {
    const std::string box = small_box_file();
    for (const char* arguments : {"--stats --quiet", "--image --stats", "--mesh --quiet",
                                  "--sensors --threads 1", "--camera --quiet"}) {
        const Outcome outcome = run_program("solve " + box + " " + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.err.find("after it, not the option"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(test_file("--quiet")));
    EXPECT_EQ(run_program("form-factors " + box + " --output --by").code, 2);
    EXPECT_EQ(run_program("solve " + box + " --accuracy 0.1 --stats - --quiet").code, 0);
}

TEST(Doubts, ASceneAThousandTimesTooLargeOrSmallIsAFinding) {
    const auto kinds = [](const std::string& length, double side) {
        const std::string s = std::to_string(side);
        std::string list;
        for (const Finding& finding :
             read_scene_text(R"({"version": 1, "units": {"length": ")" + length +
                             R"("}, "materials": {"w": {}}, "objects": [
                {"material": "w", "polygon": [[0,0,0],[)" +
                             s + ",0,0],[" + s + "," + s + ",0]]}]}")
                 .scene.findings)
            list += finding.kind + (finding.remedy.find("\"mm\"") == std::string::npos &&
                                            finding.remedy.find("in mm") == std::string::npos
                                        ? " "
                                        : ":mm ");
        return list;
    };
    EXPECT_EQ(kinds("m", 5000), "unlikely-size:mm ");
    EXPECT_EQ(kinds("mm", 5), "unlikely-size ");
    EXPECT_EQ(kinds("m", 0.005), "unlikely-size ");
    EXPECT_EQ(kinds("m", 5), "");
    EXPECT_EQ(kinds("mm", 5000), "");
    EXPECT_EQ(kinds("m", 60), "");
    EXPECT_EQ(kinds("cm", 50), "");
}

TEST(Doubts, AnAngleOfViewInRadiansIsAFinding) {
    const auto count = [](const std::string& fov) {
        return read_scene_text(scene_with("cameras", R"([{"eye": [0,0,1], "look_at": [0,0,0],
                                           "vertical_fov": )" +
                                                         fov + "}]"))
            .scene.findings.size();
    };
    EXPECT_EQ(count("0.9"), 1u);
    EXPECT_EQ(count("40"), 0u);
    EXPECT_EQ(count("5"), 0u);
}

}  // namespace
}  // namespace patchlight::server::hints_test
