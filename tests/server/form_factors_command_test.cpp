#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace patchlight::server::form_factors_command_test {
namespace {

constexpr double printed = 1e-6;  // factors are printed as floats, sums of some of them compared

const std::string command = "form-factors ";

/// Facing unit squares at distance 1, the second with a name that CSV has to quote.
const std::string facing = R"({
  "version": 1, "materials": {"m": {"reflectance": 0.5}},
  "objects": [
    {"name": "floor", "material": "m", "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
    {"name": "lid, \"upper\"", "material": "m", "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]}]})";
constexpr double facing_factor = 0.1998249;  // Howell, C-11

std::string facing_file() { return write_test_file("facing.json", facing); }

struct Line {
    std::string from, to;
    double factor = 0.0;
};
/// Lines of a table without quoted names.
std::vector<Line> lines_of(const std::string& csv) {
    std::istringstream text(csv);
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "from,to,factor,error");
    std::vector<Line> lines;
    while (std::getline(text, line)) {
        std::istringstream fields(line);
        Line read;
        std::string factor;
        std::getline(fields, read.from, ',');
        std::getline(fields, read.to, ',');
        std::getline(fields, factor, ',');
        read.factor = std::stod(factor);
        lines.push_back(read);
    }
    return lines;
}

void expect_refused(const std::string& arguments, const std::string& words) {
    const Outcome outcome = run_program(command + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(outcome.err.starts_with("patchlight: error: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err << "\nlacks: " << words;
}

void expect_no_file(const std::string& name) {
    EXPECT_FALSE(std::filesystem::exists(test_file(name))) << name;
    for (const auto& entry : std::filesystem::directory_iterator(test_file("")))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".patchlight")) << entry.path();
}

TEST(FormFactorsCommand, PrintsCsvAndNothingElseOnStandardOutput) {
    const Outcome outcome = run_program(command + facing_file());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream text(outcome.out);
    std::string header, there, back, more;
    std::getline(text, header);
    std::getline(text, there);
    std::getline(text, back);
    EXPECT_EQ(header, "from,to,factor,error");
    EXPECT_TRUE(there.starts_with("floor,\"lid, \"\"upper\"\"\",0.19982")) << there;
    EXPECT_TRUE(back.starts_with("\"lid, \"\"upper\"\"\",floor,0.19982")) << back;
    EXPECT_FALSE(std::getline(text, more)) << more;
    for (const char* line : {"patches:", "closure:", "reciproc.: exact", "findings:  none"})
        EXPECT_NE(outcome.err.find(line), std::string::npos) << outcome.err;
    EXPECT_EQ(run_program(command + "--quiet " + facing_file()).err, "");
    EXPECT_EQ(run_program(command + "- --quiet < " + facing_file()).out, outcome.out);
}

TEST(FormFactorsCommand, WritesTheFormatThatTheNameTells) {
    const std::string scene = command + facing_file() + " --quiet --output ";
    for (const char* name : {"f.csv", "f.json", "f.mtx"}) {
        const Outcome outcome = run_program(scene + name);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(read_test_file("f.csv"), run_program(command + facing_file()).out);
    const auto json = nlohmann::json::parse(read_test_file("f.json"));
    EXPECT_EQ(json["names"][1], "lid, \"upper\"");
    EXPECT_NEAR(json["areas"][1].get<double>(), 1.0, printed);
    EXPECT_NEAR(json["rows"][0]["factor"][0].get<double>(), facing_factor, printed);
    EXPECT_EQ(json["rows"][0]["to"][0], 1);
    EXPECT_NE(read_test_file("f.mtx").find("\n% 2 lid, \"upper\"\n"), std::string::npos);
}

TEST(FormFactorsCommand, MatrixMarketHoldsTheFactorsOfTheTable) {
    const std::string scene = command + small_box_file() + " --quiet --by face --output ";
    ASSERT_EQ(run_program(scene + "f.mtx").code, 0);
    ASSERT_EQ(run_program(scene + "f.csv").code, 0);
    std::istringstream text(read_test_file("f.mtx"));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
    std::vector<std::string> names;
    while (text.peek() == '%') {
        std::getline(text, line);
        if (line.starts_with("% " + std::to_string(names.size() + 1) + " "))
            names.push_back(line.substr(line.rfind(' ') + 1));
    }
    EXPECT_EQ(names, (std::vector<std::string>{"walls[0]", "walls[1]", "walls[2]", "walls[3]",
                                               "walls[4]", "walls[5]", "lamp"}));
    std::size_t rows = 0, columns = 0, entries = 0;
    text >> rows >> columns >> entries;
    EXPECT_EQ(rows, 7u);
    EXPECT_EQ(columns, 7u);
    const std::vector<Line> table = lines_of(read_test_file("f.csv"));
    ASSERT_EQ(entries, table.size());
    for (const Line& expected : table) {
        std::size_t row = 0, column = 0;
        double factor = 0.0;
        ASSERT_TRUE(text >> row >> column >> factor);
        EXPECT_EQ(names.at(row - 1), expected.from);
        EXPECT_EQ(names.at(column - 1), expected.to);
        EXPECT_EQ(factor, expected.factor);
    }
}

TEST(FormFactorsCommand, FactorsOfObjectsSumToOneInAClosedRoom) {
    const Outcome outcome = run_program(command + small_box_file());
    std::map<std::string, double> sums;
    std::set<std::string> pairs;
    for (const Line& line : lines_of(outcome.out)) {
        sums[line.from] += line.factor;
        pairs.insert(line.from + " " + line.to);
    }
    EXPECT_NEAR(sums["walls"], 1.0, 0.02) << "but for the lamp's back, which absorbs";
    EXPECT_LT(sums["walls"], 1.0);
    EXPECT_NEAR(sums["lamp"], 1.0, printed);
    EXPECT_EQ(pairs, (std::set<std::string>{"walls walls", "walls lamp", "lamp walls"}))
        << "walls see themselves, the lamp does not";
}

TEST(FormFactorsCommand, PatchesCountAsInTheTableOfPatches) {
    const std::string scene = small_box_file() + " --patch-size 0.9 --quiet";
    ASSERT_EQ(run_program("solve " + scene + " --patches p.csv").code, 0);
    const Outcome outcome = run_program(command + scene + " --by patch");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::string> wall;  // object and normal of each patch: patches of one see no other
    std::istringstream text(read_test_file("p.csv"));
    std::string row;
    std::getline(text, row);
    while (std::getline(text, row)) {
        std::vector<std::string> fields;
        std::istringstream split(row);
        for (std::string field; std::getline(split, field, ',');) fields.push_back(field);
        EXPECT_EQ(fields.at(0), std::to_string(wall.size()));
        wall.push_back(fields.at(1) + " " + fields.at(7) + " " + fields.at(8) + " " + fields.at(9));
    }
    std::set<std::string> seen;
    for (const Line& line : lines_of(outcome.out)) {
        ASSERT_LT(std::stoul(line.to), wall.size());
        EXPECT_NE(wall[std::stoul(line.from)], wall[std::stoul(line.to)]);
        seen.insert(line.from);
    }
    EXPECT_EQ(seen.size(), wall.size());
}

TEST(FormFactorsCommand, StatsTellWhatTheFactorsAreWorth) {
    const Outcome outcome = run_program(command + small_box_file() + " --output f.csv --stats -");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto stats = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(stats["status"], "converged");
    EXPECT_EQ(stats["settings"]["solve"]["form_factors"], "analytic");
    EXPECT_EQ(stats["settings"]["solve"]["patch_size"], 0.7);
    for (const char* idle : {"solver", "tolerance", "max_iterations"})
        EXPECT_FALSE(stats["settings"]["solve"].contains(idle)) << idle;
    EXPECT_FALSE(stats["streamed"].get<bool>());
    EXPECT_GT(stats["patches"], 50);
    EXPECT_LE(stats["form_factors"]["closure_max"], 1e-6);
    EXPECT_EQ(stats["form_factors"]["reciprocity_max"], 0.0);
    EXPECT_FALSE(stats["form_factors"]["open"].get<bool>());
    EXPECT_GT(stats["form_factors"]["rays"], 0);
}

TEST(FormFactorsCommand, StreamedRowsSaySoAndClaimNoReciprocity) {
    write_test_file("cube.obj",
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                    "f 1 2 3 4\nf 5 8 7 6\nf 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n");
    const Outcome outcome = run_program(
        command + "cube.obj --by face --patch-size 0.07 --memory-limit 50000000 --stats s.json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("rows one by one"), std::string::npos) << outcome.err;
    const auto stats = nlohmann::json::parse(read_test_file("s.json"));
    EXPECT_TRUE(stats["streamed"].get<bool>());
    EXPECT_FALSE(stats["form_factors"].contains("reciprocity_max"));
    const std::vector<Line> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 30u);
    EXPECT_EQ(lines[0].to, "cube[1]");
    EXPECT_NEAR(lines[0].factor, facing_factor, printed);
}

TEST(FormFactorsCommand, TakesGeometryFilesWithoutAskingForLight) {
    write_test_file("pair.obj",
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                    "g low\nf 1 2 3 4\ng high\nf 5 8 7 6\n");
    const Outcome outcome = run_program(command + "pair.obj");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<Line> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].from, "pair/low");
    EXPECT_EQ(lines[0].to, "pair/high");
    EXPECT_NEAR(lines[0].factor, facing_factor, printed);
    EXPECT_EQ(outcome.err.find("no-emitter"), std::string::npos) << outcome.err;
}

TEST(FormFactorsCommand, WritesIntoAPipe) {
    const Outcome outcome =
        run_program(command + facing_file() + " --quiet --output pipe.csv & cat pipe.csv; wait $!",
                    "rm -f pipe.csv; mkfifo pipe.csv;");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(lines_of(run_program(command + small_box_file()).out).size(), 3u);
    EXPECT_TRUE(outcome.out.starts_with("from,to,factor,error\nfloor,")) << outcome.out;
    std::filesystem::remove(test_file("pipe.csv"));
}

TEST(FormFactorsCommand, WrongArgumentsAreRefusedBeforeAnyWork) {
    const std::string scene = facing_file();
    expect_refused("", "SCENE");
    expect_refused(scene + " --by objects", "--by: unknown choice 'objects'; did you mean");
    expect_refused(scene + " --output f.txt", "must end in .csv or .json or .mtx");
    expect_refused(scene + " --output absent/f.csv", "no directory");
    expect_refused(scene + " --stats -", "standard output");
    expect_refused(scene + " --output s.json --stats ./s.json", "two outputs");
    expect_refused(scene + " --stats absent/s.json", "no directory");
    expect_refused(scene + " --image a.png", "--image");
    expect_refused(scene + " --patch-size 0", "--patch-size: must be above 0");
    expect_refused(scene + " --accuracy 0.01", "--accuracy: ");
    expect_refused(scene + " --memory-limit 1000", "the memory limit is 1000 bytes");
    expect_refused("absent.json", "absent.json: cannot be read");
    expect_refused(write_test_file("typo.json", R"({"version": 1, "objets": []})"), "/objets");
}

TEST(FormFactorsCommand, InterruptedItLeavesNoFile) {
    const std::string much = " --form-factors ray-cast --rays 1000000 --patch-size 0.1 --output ";
    for (const char* name : {"cut.csv", "cut.json", "cut.mtx"}) {
        const Outcome outcome =
            run_program(command + small_box_file() + much + name + " --stats cut-stats.json",
                        "timeout --foreground --preserve-status -s INT 0.5");
        EXPECT_EQ(outcome.code, 130) << outcome.err;
        EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
        expect_no_file(name);
        expect_no_file("cut-stats.json");
    }
}

TEST(FormFactorsCommand, AtTheTimeLimitItLeavesNoFile) {
    write_test_file("old.csv", "kept\n");
    const Outcome outcome =
        run_program(command + small_box_file() + " --time-limit 1e-6 --output old.csv");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("a limit was reached"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_test_file("old.csv"), "kept\n");
    expect_no_file("none");
}

TEST(FormFactorsCommand, HelpShowsWhatHasAnEffect) {
    const Outcome outcome = run_program(command + "--help");
    EXPECT_EQ(outcome.code, 0);
    for (const char* option : {"--by", "--output", "--stats", "--quiet", "--rays", "--threads"})
        EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
    EXPECT_EQ(outcome.out.find("--solver"), std::string::npos) << outcome.out;
    EXPECT_EQ(run_program(command + facing_file() + " --solver shooting").code, 0)
        << "it is understood, as in the scene";
}

}  // namespace
}  // namespace patchlight::server::form_factors_command_test
