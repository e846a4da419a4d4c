#include "server/input_errors.h"

#include "server/scene_json.h"

#include <gtest/gtest.h>

namespace patchlight::server::input_errors_test {
namespace {

std::vector<std::string> pointers_of(const std::string& scene) {
    std::vector<std::string> pointers;
    try {
        read_scene_text(scene);
    } catch (const InputErrors& errors) {
        for (const InputFault& fault : errors.faults()) pointers.push_back(fault.pointer);
        EXPECT_EQ(errors.pointer(), pointers.front());
        EXPECT_EQ(errors.what(), errors.faults().front().detail);
    }
    return pointers;
}

TEST(InputErrors, TellOfEachPartThatCanBeJudgedAlone) {
    const std::vector<std::string> expected{"/materials/a/reflectance",
                                            "/materials/b/colour",
                                            "/solve/rays",
                                            "/solve/tolerance",
                                            "/sensors/0/normal",
                                            "/sensors/1",
                                            "/cameras/0/up",
                                            "/objects/0/polygon",
                                            "/objects/1/children/0",
                                            "/objects/1/children/1/material",
                                            "/objects/2/rotation"};
    EXPECT_EQ(pointers_of(R"({"version": 1,
        "materials": {"a": {"reflectance": 2}, "b": {"colour": 1}, "c": {}},
        "objects": [
            {"material": "a", "polygon": [[0,0,0],[1,0,0]]},
            {"children": [{"material": "b"},
                          {"material": "d", "polygon": [[0,0,0],[1,0,0],[1,1,0]]}]},
            {"material": "c", "polygon": [[0,0,0],[1,0,0],[1,1,0]], "rotation": [0,0,0,0]},
            {"material": "c", "polygon": [[0,0,0],[1,0,0],[1,1,0]]}],
        "cameras": [{"eye": [0,0,0], "look_at": [0,0,1], "up": [0,0,1]},
                    {"eye": [0,0,0], "look_at": [0,0,1]}],
        "sensors": [{"position": [0,0,0], "normal": [0,0,0]}, {"normal": [0,0,1]}],
        "solve": {"rays": 0, "tolerance": -1, "seed": 3}})"),
              expected);
}

TEST(InputErrors, AMisspeltKeyDoesNotHideTheRest) {
    EXPECT_EQ(pointers_of(R"({"version": 1, "objets": [], "solve": {"rays": 0}})"),
              (std::vector<std::string>{"/objets", "/solve/rays"}));
}

TEST(InputErrors, WithoutMaterialsObjectsAreNotBlamed) {
    EXPECT_EQ(pointers_of(R"({"version": 1, "materials": 7,
        "objects": [{"material": "a", "polygon": [[0,0,0],[1,0,0],[1,1,0]]}]})"),
              std::vector<std::string>{"/materials"});
}

TEST(InputErrors, AreTwentyAtMost) {
    std::string objects;
    for (int k = 0; k < 100; ++k) objects += (k ? "," : "") + std::string("{}");
    const auto pointers = pointers_of(R"({"version": 1, "objects": [)" + objects + "]}");
    EXPECT_EQ(pointers.size(), 20u);
    EXPECT_EQ(pointers.back(), "/objects/19");
}

TEST(FaultList, KeepsWhatIsThrownAndNothingTwice) {
    FaultList faults;
    EXPECT_TRUE(faults.attempt([] {}));
    faults.throw_if_any();
    for (const char* pointer : {"/a", "/b", "/a"})
        EXPECT_FALSE(faults.attempt([&] { throw InputError(pointer, "wrong"); }));
    EXPECT_EQ(faults.size(), 2u);
    EXPECT_FALSE(faults.attempt([] { throw InputErrors({{"/b", "wrong"}, {"/c", "wrong"}}); }));
    EXPECT_EQ(faults.size(), 3u);
    EXPECT_THROW(faults.throw_if_any(), InputErrors);
}

}  // namespace
}  // namespace patchlight::server::input_errors_test
