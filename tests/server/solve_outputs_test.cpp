#include "server/solve_outputs.h"

#include "server/wrong_input.h"
#include "tests/server/run_program.h"
#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

#include <system_error>

namespace patchlight::server::solve_outputs_test {
namespace {

SolveOutputs with(std::optional<std::string> SolveOutputs::*output, const std::string& path) {
    SolveOutputs outputs;
    outputs.*output = path;
    return outputs;
}

TEST(SolveOutputs, TablesEndInCsvAndTextMayGoToStandardOutputOnce) {
    EXPECT_NO_THROW(checked_formats(with(&SolveOutputs::sensors, "a.csv")));
    EXPECT_NO_THROW(checked_formats(with(&SolveOutputs::patches, "a.CSV")));
    EXPECT_NO_THROW(checked_formats(with(&SolveOutputs::patches, "/dev/null")));
    EXPECT_THROW(checked_formats(with(&SolveOutputs::patches, "a.txt")), WrongInput);
    EXPECT_THROW(checked_formats(with(&SolveOutputs::sensors, "no-such-directory/a.csv")),
                 WrongInput);
    SolveOutputs outputs = with(&SolveOutputs::sensors, "-");
    EXPECT_NO_THROW(checked_formats(outputs));
    outputs.patches = "-";
    EXPECT_THROW(checked_formats(outputs), WrongInput);
    outputs.patches = "a.csv";
    outputs.sensors = "./a.csv";
    EXPECT_THROW(checked_formats(outputs), WrongInput);
}

TEST(SolveOutputs, SensorsAreAskedForWhereThereAreAny) {
    const SolveOutputs outputs = with(&SolveOutputs::sensors, "a.csv");
    Scene scene = small_job().scene;
    EXPECT_NO_THROW(require_in_scene(outputs, scene, "a.json"));
    scene.sensors.clear();
    EXPECT_THROW(require_in_scene(outputs, scene, "a.json"), WrongInput);
}

TEST(SolveOutputs, WhatCannotBeWrittenDoesNotKeepTheOthersFromIt) {
    JobResult result;
    result.solution = small_solution();
    SolveOutputs outputs = with(&SolveOutputs::sensors, test_file("absent/sensors.csv"));
    outputs.patches = test_file("patches.csv");
    EXPECT_THROW(write_outputs(outputs, {}, small_job(), result), std::system_error);
    EXPECT_TRUE(read_test_file("patches.csv").starts_with("index,"));
}

}  // namespace
}  // namespace patchlight::server::solve_outputs_test
