#include "tests/server/files/written_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace patchlight::server::stl_file_test {
namespace {

const std::string facet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\n"
    "endfacet\n";

std::string binary(std::uint32_t announced, std::initializer_list<float> numbers,
                   int triangles = 1) {
    std::string bytes(80, ' ');
    bytes += bytes_of<std::uint32_t>({announced});
    for (int k = 0; k < triangles; ++k) bytes += bytes_of<float>(numbers) + std::string(2, '\0');
    return bytes;
}

TEST(StlFile, TextIsRead) {
    const ImportedGeometry read =
        read_written("t.stl", "solid my part\n" + facet + facet + "endsolid my part\n");
    EXPECT_EQ(read.face_count(), 2u);
    EXPECT_EQ(read.vertices[1], Vec3(1, 0, 0));
    EXPECT_EQ(read.parts[0].faces[1].line, 9u);
    EXPECT_EQ(
        read_written("t.stl", "solid\n" + facet + "endsolid\nsolid b\n" + facet + "endsolid\n")
            .face_count(),
        2u);
}

TEST(StlFile, BinaryIsReadEvenIfItBeginsAsTextDoes) {
    std::string bytes = binary(2, {0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0}, 2);
    EXPECT_EQ(read_written("b.STL", bytes).vertices[4], Vec3(2, 0, 0));
    bytes.replace(0, 5, "solid");
    EXPECT_EQ(read_written("b.stl", bytes).face_count(), 2u);
}

TEST(StlFile, BinaryThatIsCutOffOrAnnouncesTooMuchIsRefused) {
    const std::string whole = binary(1, {0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0});
    expect_file_rejected("b.stl", whole.substr(0, 100),
                         "1 triangles, as it says, has 134 bytes, not 100");
    expect_file_rejected("b.stl", binary(0xFFFFFFFF, {0}), "4294967295 triangles");
    expect_file_rejected("b.stl", "", "is no STL");
    expect_file_rejected("b.stl", std::string(84, '\0'), "has no triangles");
}

TEST(StlFile, CoordinatesMustBeFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_file_rejected("b.stl", binary(1, {0, 0, 1, 0, 0, 0, 2, nan, 0, 0, 2, 0}),
                         "triangle 0: ");
    expect_file_rejected("b.stl", binary(1, {0, 0, 1, 0, 0, 0, 2, 1e30f, 0, 0, 2, 0}), "1e+15");
    expect_file_rejected("t.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 inf 0\n",
                         "t.stl:4: must be within");
}

TEST(StlFile, TextMustBeWhole) {
    expect_file_rejected("t.stl", "solid x\nendsolid\n", "has no triangles");
    expect_file_rejected("t.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                         "t.stl:4: the file ends where 'vertex' should follow");
    expect_file_rejected("t.stl", "solid x\nfacet\nouter\n",
                         "t.stl:3: expected 'outer loop', not the end of the line");
    expect_file_rejected("t.stl", "solid x\nface\n", "t.stl:2: expected 'facet' or 'endsolid'");
    expect_file_rejected("t.stl", "solid x\nfacet\nouter loop\nvertex 0 0\n",
                         "t.stl:4: a number is missing");
}

std::vector<std::string> paths_of(const ImportedGeometry& geometry) {
    std::vector<std::string> paths;
    for (const FilePart& part : geometry.parts) paths.push_back(part.path);
    return paths;
}

TEST(StlFile, SeveralSolidsAreAnObjectEachWithItsName) {
    const auto solid = [](const std::string& name) {
        return "solid " + name + "\n" + facet + "endsolid " + name + "\n";
    };
    EXPECT_EQ(paths_of(read_written("t.stl", solid("ground") + solid("roof #2"))),
              (std::vector<std::string>{"ground", "roof #2"}));
    EXPECT_EQ(paths_of(read_written("t.stl", solid("a") + solid("a") + solid("") + solid(""))),
              (std::vector<std::string>{"a", "a#2", "#2", "#3"}));
    EXPECT_EQ(paths_of(read_written("t.stl", solid("one"))), std::vector<std::string>{""});
    EXPECT_EQ(paths_of(read_written("t.stl", "solid no faces\nendsolid\n" + solid("b"))),
              std::vector<std::string>{"b"});
}

/// Public trouble with such files: slic3r#2971, numpy-stl#154, #206, meshlab#194, fstl#33.
TEST(StlFile, TextIsReadHoweverItIsSpelt) {
    const std::string text = "solid my part\n" + facet + "endsolid my part\n";
    std::string upper = text, split = text, old_mac = text, windows;
    for (char& letter : upper)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    for (const char* word : {"loop", "facet", "solid"})
        split.replace(split.find("end" + std::string(word)), 3, "end ");
    std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
    for (const char letter : text) windows += letter == '\n' ? "\r\n" : std::string(1, letter);
    for (const std::string& spelt : {upper, split, old_mac, windows, "\xEF\xBB\xBF" + text,
                                     "\n\n  " + text, "# made by hand\n" + text}) {
        const ImportedGeometry read = read_written("t.stl", spelt);
        EXPECT_EQ(read.face_count(), 1u) << spelt;
        EXPECT_TRUE(read.remarks.empty()) << spelt;
    }
    expect_file_rejected("t.stl", std::string("\xFF\xFEs\0o\0l\0i\0d\0", 12), "UTF-16");
}

TEST(StlFile, WhatIsLeftOutOrMayBeMissingIsToldOf) {
    const auto kind = [](const std::string& bytes) {
        const ImportedGeometry read = read_written("t.stl", bytes);
        return read.remarks.empty() ? "" : read.remarks.front().kind;
    };
    EXPECT_EQ(kind("solid x\n" + facet), "unfinished-file");
    EXPECT_EQ(kind("solid x\ncolor 1 0 0\n" + facet + "endsolid\n"), "colours-ignored");
    const std::string whole = binary(1, {0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 2, 0});
    EXPECT_EQ(kind(whole), "");
    EXPECT_EQ(kind(whole + "xy"), "trailing-bytes");
    EXPECT_EQ(kind("solid" + whole.substr(5) + "xy"), "trailing-bytes");
}

TEST(StlFile, AFacetMayHaveMoreThanThreeCorners) {
    const ImportedGeometry read = read_written(
        "t.stl",
        "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid\n");
    EXPECT_EQ(read.parts[0].faces[0].count, 4u);
}

}  // namespace
}  // namespace patchlight::server::stl_file_test
