#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace patchlight::server::chart_command_test {
namespace {

namespace fs = std::filesystem;

bool is_there(const std::string& name) { return fs::exists(test_file(name)); }

/// Whether nothing but whole files lies in the directory: what is being written has other names.
bool holds_only_charts(const std::string& directory) {
    for (const auto& entry : fs::directory_iterator(test_file(directory)))
        if (entry.path().stem() != "chart") return false;
    return true;
}

bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null") == 0; }

void expect_refused(const std::string& arguments, const std::string& why) {
    const Outcome outcome = run_program("chart " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << arguments << ": " << outcome.err;
}

TEST(ChartCommand, MeasuresMethodsUntilTheTimeIsUpAndWritesWhatItFound) {
    const std::string directory = "it's a \"chart\" of $HOME";
    const Outcome outcome = run_program("chart " + small_box_file() +
                                        " --output \"it's a \\\"chart\\\" of \\$HOME\" "
                                        "--time-limit 6");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("front: "), std::string::npos) << outcome.out;
    const auto document = nlohmann::json::parse(read_test_file(directory + "/chart.json"));
    EXPECT_EQ(document["status"], "complete");
    EXPECT_EQ(document["reference"]["kind"], "solve");
    ASSERT_FALSE(document["points"].empty());
    for (const auto& point : document["points"]) {
        EXPECT_GT(point["seconds"], 0.0);
        EXPECT_GT(point["error"], 0.0);
        EXPECT_LT(point["error"], 1.0);
    }
    const std::string csv = read_test_file(directory + "/chart.csv");
    const auto rows = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n'));
    EXPECT_EQ(rows, 1 + document["points"].size() + document["skipped"].size());
    EXPECT_TRUE(read_test_file(directory + "/chart.html").ends_with("</html>\n"));
    EXPECT_TRUE(holds_only_charts(directory));
    if (!has_gnuplot()) GTEST_SKIP() << "there is no gnuplot";
    EXPECT_NE(read_test_file(directory + "/chart.svg").find("</svg>"), std::string::npos);
    EXPECT_TRUE(read_test_file(directory + "/chart.png").substr(1).starts_with("PNG"));
    const std::string redraw = "cd '" + test_file("") +
                               "' && cd it*chart* && rm chart.svg && "
                               "gnuplot chart.gp 2>gnuplot.txt";
    EXPECT_EQ(std::system(redraw.c_str()), 0);
    EXPECT_TRUE(is_there(directory + "/chart.svg"));
}

TEST(ChartCommand, InterruptedItWritesWhatItHas) {
    const Outcome outcome = run_program("chart " + small_box_file() + " --output broken --quiet",
                                        "timeout --foreground --preserve-status -s INT 1.5");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    const auto document = nlohmann::json::parse(read_test_file("broken/chart.json"));
    EXPECT_EQ(document["status"], "cancelled");
    EXPECT_FALSE(document["skipped"].empty());
    EXPECT_TRUE(is_there("broken/chart.csv"));
    EXPECT_TRUE(is_there("broken/chart.html"));
    EXPECT_TRUE(holds_only_charts("broken"));
}

TEST(ChartCommand, WithoutGnuplotTheRestIsWrittenAndItIsSaid) {
    fs::create_directory(test_file("no-programs"));
    fs::create_directory(test_file("undrawn"));
    write_test_file("undrawn/chart.svg", "of an earlier chart");
    const Outcome outcome = run_program(
        "chart " + small_box_file() + " --output undrawn --time-limit 1", "PATH=no-programs");
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << outcome.err;  // 3: a slow machine
    EXPECT_NE(outcome.err.find("gnuplot is not installed"), std::string::npos) << outcome.err;
    for (const char* written : {"undrawn/chart.csv", "undrawn/chart.json", "undrawn/chart.gp"})
        EXPECT_TRUE(is_there(written)) << written;
    EXPECT_FALSE(is_there("undrawn/chart.svg"));
    EXPECT_FALSE(is_there("undrawn/chart.png"));
    EXPECT_NE(read_test_file("undrawn/chart.html").find("gnuplot is not installed"),
              std::string::npos);
}

TEST(ChartCommand, TooLittleTimeIsToldByTheExitCode) {
    const Outcome outcome =
        run_program("chart " + small_box_file() + " --output brief --time-limit 1e-6");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("too short"), std::string::npos) << outcome.err;
    EXPECT_TRUE(is_there("brief/chart.csv"));
}

TEST(ChartCommand, WrongInputIsRefusedBeforeAnyWork) {
    const std::string box = small_box_file();
    expect_refused(box, "--output");
    expect_refused(box + " --output ''", "the name is empty");
    expect_refused(box + " --output box.json", "is no directory");
    expect_refused(box + " --output no/such/place", "cannot be made");
    expect_refused(box + " --output x --time-limit 0", "--time-limit: must be above 0");
    expect_refused(box + " --output x --time-limit nan", "--time-limit: must be above 0");
    expect_refused(box + " --output x --accuracy 0.1", "unknown option '--accuracy'");
    expect_refused("missing.json --output x", "missing.json: cannot be read");
    write_test_file("empty.json", R"({"version": 1, "objects": []})");
    expect_refused("empty.json --output x", "empty.json: ");
    EXPECT_FALSE(is_there("x"));
}

TEST(ChartCommand, ASceneWithoutLightIsRefused) {
    write_test_file("dark.json", R"({"version": 1, "materials": {"grey": {"reflectance": 0.5}},
        "objects": [{"name": "plate", "material": "grey",
                     "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]}]})");
    expect_refused("dark.json --output dark", "nothing to err about");
}

}  // namespace
}  // namespace patchlight::server::chart_command_test
