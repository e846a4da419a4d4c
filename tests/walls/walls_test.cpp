#include "tests/walls/walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

namespace patchlight::walls::walls_test {
namespace {

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

const std::filesystem::path root = PATCHLIGHT_ROOT;

void expect_crossing(const char* file, const char* include) {
    const std::string source = "#pragma once\n#include " + std::string(include) + "\n";
    EXPECT_EQ(crossings(file, source).size(), 1U) << file << " includes " << include;
}

void expect_open(const char* file, const char* include) {
    const std::string source = "#include " + std::string(include) + "\n";
    EXPECT_EQ(crossings(file, source), std::vector<std::string>{}) << file;
}

TEST(Walls, AreCrossedByNoInclude) {
    for (const std::string& file : sources_below(root))
        for (const std::string& crossing : crossings(file, read(root / file)))
            ADD_FAILURE() << crossing;
}

/// Files of a folder are compiled together, where the one's call may find the other's function and
/// no compiler says so.
TEST(Walls, NoTwoFilesOfAFolderHaveAHiddenFunctionOfOneName) {
    std::map<std::string, std::string> file_of;
    for (const std::string& file : sources_below(root)) {
        const std::string folder = std::filesystem::path(file).parent_path().string();
        for (const std::string& name : hidden_functions(read(root / file))) {
            const auto [known, is_new] = file_of.try_emplace(folder + "/" + name, file);
            EXPECT_TRUE(is_new || known->second == file)
                << name << " of " << file << " and of " << known->second;
        }
    }
    EXPECT_GT(file_of.size(), 500U);
}

TEST(Walls, HiddenFunctionsAreFound) {
    EXPECT_EQ(hidden_functions("int seen(int x) {\nnamespace {\n"
                               "constexpr int x = f(2);\nstd::vector<int> two_of(int x) {\n"
                               "    return other(x);\n}\nvoid Walls::member() {}\n"
                               "char* three(\n}  // namespace\nint late() {}\n"),
              (std::vector<std::string>{"two_of", "three"}));
}

TEST(Walls, EverySourceFileIsLookedAt) {
    const std::vector<std::string> sources = sources_below(root);
    for (const char* file : {"raster/render.h", "solver/mesh/welder.cpp", "server/main.cpp"})
        EXPECT_TRUE(std::binary_search(sources.begin(), sources.end(), file)) << file;
    EXPECT_FALSE(includes_in(read(root / "solver/solution.h")).empty());
}

TEST(Walls, TheTopLevelHoldsTheRoomsAndNothingElse) {
    const std::vector<std::string> known = {"CMakeLists.txt", "Dockerfile", "README.md", "examples",
                                            "raster",         "server",     "solver",    "tests"};
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(".") || name.starts_with("build")) continue;
        EXPECT_TRUE(std::binary_search(known.begin(), known.end(), name)) << name;
    }
}

TEST(Walls, HttplibIsIncludedByOneFileAtMost) {
    std::vector<std::string> including;
    for (const std::string& file : sources_below(root))
        for (const Include& include : includes_in(read(root / file)))
            if (include.path == "httplib.h") including.push_back(file);
    EXPECT_EQ(including, std::vector<std::string>{"server/http/hardened_server.cpp"});
}

TEST(Walls, TheNetworkIsKnownToHttpAlone) {
    for (const char* include : {"<httplib.h>", "<netinet/in.h>", "<poll.h>", "<spdlog/spdlog.h>"})
        expect_crossing("server/serve_command.cpp", include);
    expect_open("server/http/connection.cpp", "<poll.h>");
    expect_crossing("server/http/connection.cpp", "<httplib.h>");
    expect_crossing("server/http/hardened_server.cpp", "\"server/scene_json.h\"");
}

TEST(Walls, RasterKnowsNobody) {
    expect_crossing("raster/render.cpp", "\"solver/mesh/patch_mesh.h\"");
    expect_crossing("raster/render.cpp", "\"server/job.h\"");
    expect_crossing("raster/image_file.cpp", "<OpenImageIO/imageio.h>");
    expect_crossing("raster/tone.cpp", "<iostream>");
    expect_open("raster/image_codec.cpp", "<OpenImageIO/imageio.h>");
}

TEST(Walls, SolverKnowsNeitherServerNorJsonNorPrinting) {
    for (const char* file : {"solver/solve_scene.cpp", "solver/mesh/welder.cpp"})
        for (const char* include :
             {"\"server/job.h\"", "<nlohmann/json.hpp>", "<CLI/CLI.hpp>", "<httplib.h>",
              "<spdlog/spdlog.h>", "<iostream>", "\"raster/render.h\"", "<OpenImageIO/imageio.h>"})
            expect_crossing(file, include);
}

TEST(Walls, EmbreeLivesInOneFile) {
    expect_crossing("solver/rays/patch_sampler.cpp", "<embree3/rtcore.h>");
    expect_crossing("solver/form_factors/analytic_engine.cpp", "<embree4/rtcore.h>");
    expect_open("solver/rays/embree_scene.h", "<embree4/rtcore.h>");
}

TEST(Walls, LowerRoomsOfTheSolverNeverIncludeHigherOnes) {
    const std::vector<const char*> upwards = {
        "solver/scene/",     "solver/mesh/",     "solver/rays/", "solver/form_factors/",
        "solver/transport/", "solver/accuracy/", "solver/solve_"};
    for (std::size_t low = 0; low < upwards.size(); ++low)
        for (std::size_t high = low + 1; high < upwards.size(); ++high) {
            const std::string file = upwards[low] + std::string("plan.cpp");
            const std::string include = "\"" + std::string(upwards[high]) + "scene.h\"";
            if (low + 1 < upwards.size()) expect_crossing(file.c_str(), include.c_str());
        }
    expect_crossing("solver/solution.h", "\"solver/transport/stop_rule.h\"");
    expect_crossing("solver/rays/ray_scene.h", "\"solver/solution.h\"");
    expect_open("solver/transport/residual.cpp", "\"solver/solution.h\"");
    expect_open("solver/findings/gaps.cpp", "\"solver/rays/ray_scene.h\"");
    expect_crossing("solver/findings/gaps.cpp", "\"solver/form_factors/form_factor_engine.h\"");
    expect_crossing("solver/findings/gaps.cpp", "\"solver/solve_plan.h\"");
    expect_crossing("solver/rays/ray_scene.cpp", "\"solver/findings/gaps.h\"");
}

TEST(Walls, OnlyTheHemicubeDrawsWithTheItemBuffer) {
    expect_open("solver/form_factors/hemicube_engine.cpp", "\"raster/item_buffer.h\"");
    expect_crossing("solver/form_factors/hemicube_engine.cpp", "\"raster/render.h\"");
    expect_crossing("solver/form_factors/analytic_engine.cpp", "\"raster/item_buffer.h\"");
}

TEST(Walls, IncludesStartAtTheRootHoweverTheyAreWritten) {
    expect_crossing("solver/mesh/welder.cpp", "\"welder.h\"");
    expect_crossing("solver/mesh/welder.cpp", "\"../../server/job.h\"");
    expect_crossing("solver/mesh/welder.cpp", "\"solver/mesh/../../server/job.h\"");
    EXPECT_EQ(crossings("solver/solution.h", "  #  include<iostream> // why not\n").size(), 1U);
    EXPECT_EQ(crossings("attic/old.cpp", "").size(), 1U);
}

}  // namespace
}  // namespace patchlight::walls::walls_test
