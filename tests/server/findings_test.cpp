#include "server/scene_file.h"
#include "solver/solve_scene.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace patchlight::server::findings_test {
namespace {

using nlohmann::json;

/// What `check` tells of a scene: "kind (objects)", a line each.
std::string told_of_example(const std::string& name) {
    const Job job = read_scene_file(PATCHLIGHT_EXAMPLES "/" + name);
    std::string told;
    for (const Finding& finding : find_flaws(job.scene, job.settings)) {
        told += finding.kind;
        for (const std::string& object : finding.objects) told += " " + object;
        told += "\n";
    }
    return told;
}

TEST(Findings, OfTheExamplesAreTrue) {
    EXPECT_EQ(told_of_example("cornell_box.json"), "non-planar left wall\n");  // as it was measured
    EXPECT_EQ(told_of_example("grey_room.json"), "");  // panels flush in the ceiling are meant so
    EXPECT_EQ(told_of_example("courtyard.json"), "");
    EXPECT_EQ(told_of_example("furnished_room.json"), "");
    EXPECT_EQ(told_of_example("imported.json"), "");
    EXPECT_EQ(told_of_example("alcove.obj"), "");
}

TEST(Findings, OfACityAreNone) {
    const Outcome outcome = run_program("check -", "sh " PATCHLIGHT_EXAMPLES "/block_city.sh 5 |");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("findings:  none"), std::string::npos) << outcome.out;
}

constexpr const char* floating_box = R"({"version": 1,
  "materials": {"w": {"reflectance": 0.5}, "l": {"reflectance": 0, "exitance": 10}},
  "objects": [
    {"name": "floor", "material": "w", "polygon": [[0,0,0],[3,0,0],[3,3,0],[0,3,0]]},
    {"name": "lamp", "material": "l", "polygon": [[0,0,2],[0,3,2],[3,3,2],[3,0,2]]},
    {"name": "box", "material": "w", "mesh": {
      "vertices": [[1,1,0.002],[2,1,0.002],[2,2,0.002],[1,2,0.002],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
      "faces": [[0,3,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]}}],
  "solve": {"patch_size": 1, "rays": 64}})";

TEST(Findings, StandInCheckSummaryStatsAndFactors) {
    const std::string scene = write_test_file("floating.json", floating_box);
    const std::string line = "finding:   floating-object (box, floor): ";
    EXPECT_NE(run_program("check " + scene).out.find(line), std::string::npos);
    EXPECT_NE(run_program("solve " + scene).out.find(line), std::string::npos);
    for (const std::string command : {"solve ", "form-factors "}) {
        const Outcome outcome = run_program(command + scene + " --quiet --stats stats.json");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const json found = json::parse(read_test_file("stats.json"))["findings"];
        ASSERT_EQ(found.size(), 1u) << command;
        EXPECT_EQ(found[0]["kind"], "floating-object");
        EXPECT_EQ(found[0]["objects"], json({"box", "floor"}));
        EXPECT_FALSE(found[0]["remedy"].get<std::string>().empty());
    }
}

}  // namespace
}  // namespace patchlight::server::findings_test
