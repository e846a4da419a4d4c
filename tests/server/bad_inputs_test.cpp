#include "server/http/scene_problem.h"
#include "server/input_errors.h"
#include "server/run_job.h"
#include "server/scene_json.h"
#include "solver/solve_scene.h"
#include "solver/view_factors.h"
#include "tests/server/lit_square.h"

#include <gtest/gtest.h>

namespace patchlight::server::bad_inputs_test {
namespace {

/// What a scene is to be answered with by every way in.
struct BadInput {
    std::string text;
    int status;  // HTTP's: 400 no JSON, 422 no scene; the command line's exit code is 2 for both
    std::string place;  // JSON pointer, or empty
    std::string words;  // somewhere in what is said of it
};

/// The problem, or status 200.
Problem outcome(const std::string& text, const std::function<void(const Job&)>& work) {
    try {
        work(read_scene_text(text));
    } catch (const InputError& error) {
        return problem_of(error);
    }
    Problem none;
    none.status = 200;
    return none;
}

void expect_told(const BadInput& input, const std::function<void(const Job&)>& work) {
    const Problem problem = outcome(input.text, work);
    const std::string shown = input.text.substr(0, 300) + "\n" + problem.detail;
    EXPECT_EQ(problem.status, input.status) << shown;
    const std::string place =
        problem.members.contains("pointer") ? problem.members["pointer"].get<std::string>() : "";
    EXPECT_EQ(place, input.place) << shown;
    EXPECT_NE((problem.kind + problem.detail).find(input.words), std::string::npos)
        << shown << "\nlacks: " << input.words;
}

void expect_each_told(const std::vector<BadInput>& inputs) {
    for (const BadInput& input : inputs) {
        expect_told(input, [](const Job& job) { run_job(job, {}, 0.0, {}); });
        expect_told(input, [](const Job& job) {
            ViewFactorSolver(job.scene, job.settings, Grouping::object)
                .find([](const auto&) {}, {});
        });
    }
}

std::string material(const std::string& members) {
    return lit_square(R"({"materials": {"white": {)" + members + "}}}");
}

std::string camera(const std::string& members) {
    return lit_square(R"({"cameras": [{"eye": [0,0,3], "look_at": [0,0,0], )" + members + "}]}");
}

std::string solve(const std::string& members) {
    return lit_square(R"({"solve": {)" + members + "}}");
}

std::string sensor(const std::string& members) {
    return lit_square(R"({"sensors": [{"name": "s", )" + members + "}]}");
}

const std::string triangle = R"("mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0]], "faces": )";

TEST(BadInputs, BytesThatAreNoJson) {
    std::string deepest;
    for (int level = 0; level < 64; ++level) deepest += "/0";
    expect_each_told({
        {"", 400, "", "empty"},
        {R"({"a":)", 400, "", "json-syntax"},
        {std::string(100'000, '['), 400, deepest, "json-too-deep"},
        {R"({"a": 1e999})", 400, "", "json-number-range"},
        {R"({"a": NaN})", 400, "", "json-syntax"},
        {R"({"a": Infinity})", 400, "", "json-syntax"},
        {"{\"a\": \"\xff\"}", 400, "", "json-encoding"},
        {R"({"a": "\ud800"})", 400, "", "json-encoding"},
        {std::string("{}\0", 3), 400, "", "json-encoding"},
        {R"({"version": 1, "version": 1})", 400, "/version", "given twice"},
    });
}

TEST(BadInputs, DocumentsThatAreNoScenes) {
    expect_each_told({
        {"[]", 422, "", "must be an object, not an array"},
        {R"("x")", 422, "", "must be an object, not a text"},
        {"null", 422, "", "not null"},
        {"{}", 422, "", "needs 'objects'"},
        {lit_square(R"({"version": 2})"), 422, "/version", "must be 1"},
        {lit_square(R"({"objects": []})"), 422, "/objects", "at least one"},
        {lit_square(R"({"objets": []})"), 422, "/objets", "did you mean 'objects'?"},
        {lit_square(R"({"units": {"length": "km"}})"), 422, "/units/length", "km"},
    });
}

TEST(BadInputs, Materials) {
    expect_each_told({
        {material(R"("reflectance": 1.2)"), 422, "/materials/white/reflectance", "below 1"},
        {material(R"("reflectance": 1)"), 422, "/materials/white/reflectance", "below 1"},
        {material(R"("reflectance": -0.1)"), 422, "/materials/white/reflectance", "at least 0"},
        {material(R"("emision": 1)"), 422, "/materials/white/emision", "unknown key"},
        {material(R"("exitance": -1)"), 422, "/materials/white/exitance", "at least 0"},
        {material(R"("exitance": 1e300)"), 422, "/materials/white/exitance", "at most 1e+15"},
        {material(R"("exitance": 1, "radiance": 1)"), 422, "/materials/white/radiance", "one of"},
        {material(R"("reflectance": [0.5, 0.5])"), 422, "/materials/white/reflectance", "3"},
        {material(R"("two_sided": 1)"), 422, "/materials/white/two_sided", "true or false"},
    });
}

TEST(BadInputs, Geometry) {
    expect_each_told({
        {lit_object(triangle + "[[0,1,99]]}"), 422, "/objects/0/mesh/faces/0/2", "there are 3"},
        {lit_object(triangle + "[[0,1,-1]]}"), 422, "/objects/0/mesh/faces/0/2", "-1"},
        {lit_object(triangle + "[[0,1,1.5]]}"), 422, "/objects/0/mesh/faces/0/2", "whole number"},
        {lit_object(R"("polygon": [[0,0,0],null,[1,1,0]])"), 422, "/objects/0/polygon/1", "null"},
        {lit_object(R"("polygon": [[0,0,0],["a",0,0],[1,1,0]])"), 422, "/objects/0/polygon/1/0",
         "number"},
        {lit_object(R"("polygon": [[0,0],[1,0,0],[1,1,0]])"), 422, "/objects/0/polygon/0", "not 2"},
        {lit_object(R"("polygon": [[0,0,0],[1e30,0,0],[1,1,0]])"), 422, "/objects/0/polygon/1/0",
         "at most"},
        {lit_object(R"("polygon": [[0,0,0],[1,1,0],[1,0,0],[0,1,0]])"), 422, "/objects/0/polygon",
         "crosses itself"},
        {lit_object(R"("polygon": [[0,0,0],[3,3,0],[3,0,0],[0,2,0]])"), 422, "/objects/0/polygon",
         "crosses itself"},
        {lit_object(R"("polygon": [[0,0,0],[1,0,0],[2,0,0],[1,0,0],[1,1,0]])"), 422,
         "/objects/0/polygon", "crosses itself"},
        {lit_square(
             R"({"objects": [{"material": "white", "polygon": [[0,0,0],[1,0,0],[2,0,0]]}]})"),
         422, "/objects", "area"},
        {lit_object(R"("instance": "chair")"), 422, "/objects/0/instance", "no definition"},
        {lit_object(R"("file": "/etc/passwd")"), 422, "/objects/0/file", ""},
        {lit_object(R"("flux": 5, "polygon": [[0,0,0],[1,0,0],[1,1,0]])"), 422, "/objects/0/flux",
         "emits"},
    });
}

TEST(BadInputs, DefinitionsWithoutEnd) {
    std::string definitions =
        R"("d12": {"material": "white", "polygon": [[0,0,0],[1,0,0],[0,1,0]]})";
    for (int k = 0; k < 12; ++k) {
        std::string children;
        for (int copy = 0; copy < 10; ++copy)
            children +=
                std::string(copy ? "," : "") + R"({"instance": "d)" + std::to_string(k + 1) + "\"}";
        definitions += ", \"d" + std::to_string(k) + R"(": {"children": [)" + children + "]}";
    }
    expect_each_told({
        {lit_square(R"({"definitions": {"a": {"instance": "a"}}, "objects": [{"instance": "a"}]})"),
         422, "/definitions/a/instance", "contains itself"},
        {lit_square("{\"definitions\": {" + definitions + R"(}, "objects": [{"instance": "d0"}]})"),
         422, "/objects/0", "polygons, the limit"},
    });
}

TEST(BadInputs, CamerasAndSensors) {
    expect_each_told({
        {lit_square(R"({"cameras": [{"eye": [0,0,3], "look_at": [0,0,3]}]})"), 422,
         "/cameras/0/look_at", "differ from 'eye'"},
        {camera(R"("vertical_fov": 0)"), 422, "/cameras/0/vertical_fov", "at least 0.001"},
        {camera(R"("vertical_fov": 180)"), 422, "/cameras/0/vertical_fov", "below 180"},
        {camera(R"("up": [0,0,1])"), 422, "/cameras/0/up", "along the view"},
        {camera(R"("size": [100000,100000])"), 422, "/cameras/0/size/0", "16384"},
        {camera(R"("size": [0,10])"), 422, "/cameras/0/size/0", "from 1"},
        {sensor(R"("position": [0,0,0.5], "normal": [0,0,0])"), 422, "/sensors/0/normal", "zero"},
        {sensor(R"("position": [0,0,0.5])"), 422, "/sensors/0", "needs 'normal'"},
        {sensor(R"("normal": [0,0,1])"), 422, "/sensors/0", "one of"},
    });
}

TEST(BadInputs, SolveSettings) {
    expect_each_told({
        {solve(R"("patch_size": 0)"), 422, "/solve/patch_size", "above 0"},
        {solve(R"("patch_size": 1e-300)"), 422, "/solve/patch_size", "cannot be made"},
        {solve(R"("patch_size": 1e-8)"), 422, "/solve/patch_size", "memory limit is"},
        {solve(R"("memory_limit": 1)"), 422, "/solve/patch_size", "memory limit is 1 bytes"},
        {solve(R"("tolerance": 0)"), 422, "/solve/tolerance", "above 0"},
        {solve(R"("rays": 2147483648)"), 422, "/solve/rays", "16777216"},
        {solve(R"("seed": -1)"), 422, "/solve/seed", "from 0"},
        {solve(R"("max_iterations": 0)"), 422, "/solve/max_iterations", "from 1"},
        {solve(R"("time_limit": 0)"), 422, "/solve/time_limit", "above 0"},
        {solve(R"("form_factors": "hemicube", "rays": 9)"), 422, "/solve/rays", "no rays"},
        {solve(R"("form_factors": "analytic", "hemicube_resolution": 9)"), 422,
         "/solve/hemicube_resolution", "belongs to"},
    });
}

}  // namespace
}  // namespace patchlight::server::bad_inputs_test
