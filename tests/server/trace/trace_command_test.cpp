#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <sstream>

namespace patchlight::server::trace_command_test {
namespace {

namespace fs = std::filesystem;

std::set<std::string> files_in(const std::string& directory) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(test_file(directory)))
        names.insert(entry.path().filename().string());
    return names;
}

/// Signature, header and end of the format (W3C, "Portable Network Graphics", 2003).
void expect_png(const std::string& file) {
    const std::string bytes = read_test_file(file);
    EXPECT_TRUE(bytes.starts_with("\x89PNG\r\n\x1a\n")) << file;
    EXPECT_EQ(bytes.substr(std::min<std::size_t>(12, bytes.size()), 4), "IHDR") << file;
    EXPECT_TRUE(bytes.ends_with("IEND\xae\x42\x60\x82")) << file;
}

/// What every trace holds.
void expect_whole(const std::string& directory) {
    const std::set<std::string> names = files_in(directory);
    for (const char* name :
         {"index.html", "convergence.csv", "convergence.svg", "row.csv", "row.png", "last.png",
          "hemicube.png", "hemicube-delta.png", "hemicube-top.png", "hemicube-plus-x.png",
          "hemicube-minus-x.png", "hemicube-plus-y.png", "hemicube-minus-y.png"})
        EXPECT_TRUE(names.contains(name)) << directory << " lacks " << name;
    const std::string page = read_test_file(directory + "/index.html");
    EXPECT_TRUE(page.ends_with("</html>\n"));
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find("http"), std::string::npos) << "it must need nothing from outside";
    for (const std::string& name : names) {
        if (name.ends_with(".png")) expect_png(directory + "/" + name);
        const bool is_shown = name.ends_with(".png") || name.ends_with(".svg");
        EXPECT_EQ(page.find("src=\"" + name + "\"") != std::string::npos, is_shown) << name;
    }
}

/// The residuals of convergence.csv are those of the result.
void expect_same_convergence(const std::string& directory, const nlohmann::json& stats) {
    std::istringstream csv(read_test_file(directory + "/convergence.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "iteration,seconds,residual,unshot");
    for (const auto& step : stats["convergence"]) {
        ASSERT_TRUE(std::getline(csv, line));
        std::istringstream fields(line);
        std::string iteration, seconds, residual, unshot;
        std::getline(fields, iteration, ',');
        std::getline(fields, seconds, ',');
        std::getline(fields, residual, ',');
        std::getline(fields, unshot, ',');
        EXPECT_EQ(std::stoi(iteration), step["iteration"].get<int>());
        EXPECT_EQ(std::stod(residual), step["residual"].get<double>());
        EXPECT_EQ(unshot.empty(), !step.contains("unshot"));
    }
    EXPECT_FALSE(std::getline(csv, line)) << line;
}

nlohmann::json solve(const std::string& arguments) {
    const Outcome outcome = run_program("solve " + small_box_file() + " " + arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
    return nlohmann::json::parse(read_test_file("s.json"));
}

TEST(Trace, ShowsShotsWithAndWithoutAmbientAndChangesNothing) {
    const std::string how = "--solver shooting --tolerance 1e-3 --stats s.json ";
    const auto plain = solve(how), traced = solve(how + "--trace shots --trace-patch 3");
    EXPECT_EQ(plain["result_hash"], traced["result_hash"]);
    expect_whole("shots");
    expect_same_convergence("shots", traced);
    const std::set<std::string> names = files_in("shots");
    for (const char* step : {"0000001", "0000002", "0000003", "0000005", "0000010", "0000020"}) {
        const std::string name = std::string("step-") + step;
        ASSERT_TRUE(names.contains(name + ".png")) << name;
        ASSERT_TRUE(names.contains(name + "-without-ambient.png")) << name;
        EXPECT_NE(read_test_file("shots/" + name + ".png"),
                  read_test_file("shots/" + name + "-without-ambient.png"))
            << name;
    }
    EXPECT_FALSE(names.contains("step-0000004.png"));
    EXPECT_NE(read_test_file("shots/step-0000001-without-ambient.png"),
              read_test_file("shots/step-0000020-without-ambient.png"))
        << "the walls have shot at the floor meanwhile";
    EXPECT_NE(read_test_file("shots/index.html").find("Patch 3 of <b>walls</b>"),
              std::string::npos);
}

TEST(Trace, ShowsSweepsAndChangesNothing) {
    const std::string how = "--solver gauss-seidel --form-factors hemicube --stats s.json ";
    const auto plain = solve(how), traced = solve(how + "--trace deep/er/sweeps");
    EXPECT_EQ(plain["result_hash"], traced["result_hash"]);
    expect_whole("deep/er/sweeps");
    expect_same_convergence("deep/er/sweeps", traced);
    EXPECT_TRUE(files_in("deep/er/sweeps").contains("step-0000001.png"));
    EXPECT_NE(read_test_file("deep/er/sweeps/index.html").find("of <b>lamp</b>"), std::string::npos)
        << "a lamp's row is shown at first";
}

TEST(Trace, OfASolveToAnAccuracyHasNoStepsAndSaysSo) {
    const auto traced = solve("--accuracy 0.1 --stats s.json --trace accurate");
    EXPECT_TRUE(traced["error"].contains("target"));
    expect_whole("accurate");
    EXPECT_NE(read_test_file("accurate/index.html").find("there are no steps to show"),
              std::string::npos);
}

TEST(Trace, WhereNothingCanBeWrittenIsRefusedBeforeAnyWork) {
    write_test_file("file.txt", "kept");
    const auto expect_refused = [](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run_program("solve " + small_box_file() + " " + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    };
    expect_refused("--trace file.txt", "--trace file.txt: the directory cannot be made");
    expect_refused("--trace file.txt/deep", "the directory cannot be made");
    expect_refused("--trace ''", "--trace");
    expect_refused("--trace-patch 1", "--trace");
    expect_refused("--trace t --trace-patch 1000000", "patches, numbered from 0");
    EXPECT_EQ(read_test_file("file.txt"), "kept");
}

TEST(Trace, AFileThatCannotBeWrittenIsOurSide) {
    fs::create_directories(test_file("blocked/row.png"));
    const Outcome outcome = run_program("solve " + small_box_file() + " --trace blocked");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("row.png"), std::string::npos) << outcome.err;
    for (const std::string& name : files_in("blocked"))
        EXPECT_FALSE(name.starts_with(".")) << "no torn file: " << name;
}

TEST(Trace, InterruptedItLeavesWhatWasDoneWithItsPage) {
    const Outcome outcome =
        run_program("solve " + small_box_file() +
                        " --solver shooting --form-factors ray-cast --rays 65536 --patch-size 0.05"
                        " --tolerance 1e-9 --trace cut",
                    "timeout --foreground --preserve-status -s INT 2");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    const std::string page = read_test_file("cut/index.html");
    EXPECT_TRUE(page.ends_with("</html>\n"));
    EXPECT_NE(page.find("interrupted"), std::string::npos);
    expect_png("cut/last.png");
}

}  // namespace
}  // namespace patchlight::server::trace_command_test
