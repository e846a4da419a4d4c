#include "tests/server/run_program.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>

namespace patchlight::server::command_line_test {
namespace {

const std::string& box = small_box;

std::string box_file() { return small_box_file(); }

void expect_refused(const std::string& arguments, const std::string& words) {
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(outcome.err.starts_with("patchlight: error: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err << "\nlacks: " << words;
}

TEST(CommandLine, VersionAndHelpAreAnswers) {
    EXPECT_EQ(run_program("--version").code, 0);
    EXPECT_EQ(run_program("--version").out, std::string("patchlight ") + PATCHLIGHT_VERSION + "\n");
    for (const char* asked : {"--help", "solve --help", "check --help"}) {
        const Outcome outcome = run_program(asked);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_NE(outcome.out.find("Usage"), std::string::npos);
        EXPECT_EQ(outcome.err, "");
    }
}

TEST(CommandLine, CheckTellsTheCost) {
    const Outcome outcome = run_program("check " + box_file());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const char* line : {"patches:", "memory:", "time:", "finding"})
        EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
}

TEST(CommandLine, SolveWithoutOutputsPrintsASummary) {
    const Outcome outcome = run_program("solve " + box_file());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");  // no progress where there is no terminal
    EXPECT_TRUE(outcome.out.starts_with("status:    converged")) << outcome.out;
}

TEST(CommandLine, StatsGoToStandardOutputAndNothingElseDoes) {
    const Outcome outcome = run_program("solve --stats - " + box_file());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["objects"][0]["name"], "walls");
    EXPECT_EQ(result["sensors"][0]["name"], "desk");
    EXPECT_EQ(result["settings"]["solve"]["patch_size"], 0.7);
}

TEST(CommandLine, ASceneComesFromStandardInputToo) {
    EXPECT_EQ(run_program("check - < " + box_file()).code, 0);
    write_test_file("bad.json", "{");
    expect_refused("check - < bad.json", "standard input:1:2: ");
}

TEST(CommandLine, PicturesAreWrittenInEveryFormatAskedFor) {
    const Outcome outcome = run_program("solve " + box_file() +
                                        " --image a.pfm --image b.pfm --size 8x6 --stats s.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(read_test_file("a.pfm").starts_with("PF\n8 6\n"));
    EXPECT_EQ(read_test_file("a.pfm"), read_test_file("b.pfm"));
    const auto result = nlohmann::json::parse(read_test_file("s.json"));
    EXPECT_EQ(result["images"][0]["width"], 8);
    EXPECT_EQ(result["images"][0]["camera"], "main");
    EXPECT_EQ(result["settings"]["cameras"][0]["size"][1], 6);
}

TEST(CommandLine, PngAndExrAreWritten) {
    const Outcome outcome = run_program(
        "solve " + box_file() + " --image a.png --image a.exr --exposure -1.5 --stats s.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(read_test_file("a.png").starts_with("\x89PNG"));
    EXPECT_TRUE(read_test_file("a.exr").starts_with("\x76\x2f\x31\x01"));
    const auto images = nlohmann::json::parse(read_test_file("s.json"))["images"];
    EXPECT_EQ(images[0]["exposure"], -1.5);
    EXPECT_FALSE(images[1].contains("exposure"));
}

TEST(CommandLine, OptionsOverrideTheScene) {
    const Outcome outcome =
        run_program("solve " + box_file() + " --patch-size .9 --seed 7 --threads 1 --stats -");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["settings"]["solve"]["patch_size"], 0.9);
    EXPECT_EQ(result["settings"]["solve"]["seed"], 7);
    EXPECT_EQ(result["threads"], 1);
}

TEST(CommandLine, TheResultIsTheSameFromAnyNumberOfThreads) {
    const auto hash = [](const std::string& threads) {
        const Outcome outcome =
            run_program("solve " + box_file() + " --stats - --threads " + threads);
        return nlohmann::json::parse(outcome.out)["result_hash"];
    };
    EXPECT_EQ(hash("1"), hash("3"));
}

TEST(CommandLine, WhatTheSolverRefusesIsBlamedOnWhoGaveIt) {
    expect_refused("solve " + box_file() + " --patch-size 1e-6", "--patch-size: ");
    const std::string scene = std::string(box).replace(box.find("0.7, \"form"), 3, "1e-6");
    write_test_file("fine.json", scene);
    expect_refused("solve fine.json", "fine.json: /solve/patch_size: ");
}

TEST(CommandLine, WrongScenesAreToldWithFileAndPlace) {
    write_test_file("typo.json", R"({"version": 1, "objets": []})");
    expect_refused("solve typo.json", "typo.json: /objets: unknown key 'objets'; did you mean");
    write_test_file("syntax.json", "{\n  \"version\": 1,\n  x\n}");
    expect_refused("check syntax.json", "syntax.json:3:3: ");
    expect_refused("solve missing.json", "missing.json: cannot be read: No such file");
    expect_refused("solve .", "is a directory");
}

TEST(CommandLine, EachMistakeIsToldOnALineOfItsOwn) {
    write_test_file("three.json", R"({"version": 1, "objects": [{}, {}], "solve": {"rays": 0}})");
    const Outcome outcome = run_program("check three.json");
    EXPECT_EQ(outcome.code, 2);
    std::istringstream lines(outcome.err);
    for (const char* place : {"/solve/rays", "/objects/0", "/objects/1"}) {
        std::string line;
        std::getline(lines, line);
        EXPECT_TRUE(line.starts_with(std::string("patchlight: error: three.json: ") + place + ": "))
            << line;
    }
    const Outcome options = run_program("check " + box_file() + " --rays 0 --tolerance 2");
    EXPECT_NE(options.err.find("error: --rays: "), std::string::npos) << options.err;
    EXPECT_NE(options.err.find("error: --tolerance: "), std::string::npos) << options.err;
}

TEST(CommandLine, AGeometryFileIsAScene) {
    write_test_file("floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng half\nf 1 2 3\n");
    const Outcome outcome = run_program("solve floor.obj --stats - --patch-size 1");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["objects"][0]["name"], "floor/half");
    EXPECT_EQ(result["findings"][0]["kind"], "default-material");
    write_test_file("UP.STL", "solid\n");
    expect_refused("check UP.STL", "error: UP.STL: has no triangles");
    write_test_file("bad.obj", "v 0 0 0\n\nf 1 2 3\n");
    expect_refused("check bad.obj", "error: bad.obj:3: vertex 2 does not exist");
    expect_refused("check ./bad.obj", "error: ./bad.obj:3: vertex 2");
    expect_refused("check none.gltf", "error: none.gltf: cannot be read: No such file");
    write_test_file("flat.obj", "v 0 0 0\nf 1 1 1\n");
    expect_refused("check flat.obj", "error: flat.obj: no polygon of the scene has an area");
}

TEST(CommandLine, NamesInOtherEncodingsDoNotSpoilTheResult) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write_test_file("k\xFC.obj",
                    "g K\xFC"
                    "che\nusemtl t\xFCr\n" +
                        triangle);
    const Outcome outcome = run_program("solve k\xFC.obj --stats - --patch-size 1");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto result = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(result["objects"][0]["name"], "k?/K?che");
    EXPECT_TRUE(result["settings"]["materials"].contains("t?r"));
}

TEST(CommandLine, FilesAreRelativeToTheSceneThatNamesThem) {
    std::filesystem::create_directories(test_file("below"));
    write_test_file("below/floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_test_file("below/scene.json", R"({"version": 1, "objects": [{"file": "floor.obj"}]})");
    EXPECT_EQ(run_program("check below/scene.json").code, 0);
    expect_refused("check - < below/scene.json", "/objects/0/file: is relative to");
}

TEST(CommandLine, WrongArgumentsAreRefused) {
    const std::string solve = "solve " + box_file() + " ";
    expect_refused("", "subcommand");
    expect_refused("slove box.json", "did you mean 'solve'?");
    expect_refused("solve", "SCENE");
    expect_refused(solve + "--patchsize 1", "did you mean '--patch-size'?");
    expect_refused(solve + "--patch-size 0", "--patch-size: must be above 0");
    expect_refused(solve + "--patch-size two", "--patch-size: must be a number");
    expect_refused(solve + "--solver gauss", "--solver: unknown choice 'gauss'");
    expect_refused(solve + "--threads 0", "--threads");
    expect_refused(solve + "--image a.gif", ".png, .exr or .pfm");
    expect_refused(solve + "--image no-such-directory/a.png", "no directory");
    expect_refused(solve + "--stats no-such-directory/a.json", "no directory");
    expect_refused(solve + "--image a.png --image ./a.png", "two outputs");
    expect_refused(solve + "--image a.png --camera mian", "did you mean 'main'?");
    expect_refused(solve + "--image a.png --size 10", "--size: must be WIDTHxHEIGHT");
    expect_refused(solve + "--image a.png --size 100000x100000", "from 1 to 16384");
    expect_refused(solve + "--image a.png --exposure nan", "--exposure");
    expect_refused(solve + "--image a.pfm --exposure 1", "only .png");
    expect_refused(solve + "--size 10x10", "--image");
}

TEST(CommandLine, ClustersWantAnAccuracy) {
    const std::string solve = "solve " + box_file() + " --solver hierarchical ";
    expect_refused(solve + "--patch-size 0.1", "solves to an accuracy; give `accuracy`");
    const Outcome outcome = run_program(solve + "--accuracy 0.1 --form-factors auto");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(CommandLine, AFullDiskIsOurSide) {
    for (const char* full : {"--stats /dev/full", "--stats - > /dev/full"}) {
        const Outcome outcome = run_program("solve " + box_file() + " " + full);
        EXPECT_EQ(outcome.code, 1) << full;
        EXPECT_TRUE(outcome.err.starts_with("patchlight: error: ")) << outcome.err;
    }
}

TEST(CommandLine, WithoutConvergenceItSaysSoAndWritesItsOutputs) {
    const Outcome outcome =
        run_program("solve " + box_file() + " --max-iterations 1 --tolerance 1e-9 --stats s.json");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("not converged"), std::string::npos) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(read_test_file("s.json"))["status"], "limit");
}

TEST(CommandLine, AnInterruptedSolveWritesWhatThereIs) {
    const Outcome outcome =
        run_program("solve " + box_file() +
                        " --form-factors ray-cast --rays 1000000 --patch-size 0.1"
                        " --stats s.json --image i.pfm",
                    "timeout --foreground --preserve-status -s INT 1");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(read_test_file("s.json"))["status"], "cancelled");
    EXPECT_TRUE(read_test_file("i.pfm").starts_with("PF\n32 24\n"));
}

TEST(CommandLine, NothingIsLeftBesideTheOutputs) {
    run_program("solve " + box_file() + " --image only.pfm");
    for (const auto& entry : std::filesystem::directory_iterator(test_file("")))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".patchlight")) << entry.path();
}

}  // namespace
}  // namespace patchlight::server::command_line_test
