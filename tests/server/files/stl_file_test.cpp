#include "tests/server/files/written_files.h"

#include <gtest/gtest.h>

#include <limits>

namespace patchlight::server {
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
    expect_file_rejected("b.stl", whole + "x", "not 135");
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
    expect_file_rejected("t.stl", "solid x\n" + facet, "t.stl:8: the file ends before 'endsolid'");
    expect_file_rejected("t.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                         "t.stl:4: the file ends where 'vertex' should follow");
    expect_file_rejected("t.stl", "solid x\nfacet\nouter\n",
                         "t.stl:3: expected 'outer loop', not the end of the line");
    expect_file_rejected("t.stl", "solid x\nface\n", "t.stl:2: expected 'facet' or 'endsolid'");
    expect_file_rejected("t.stl", "solid x\nfacet\nouter loop\nvertex 0 0\n",
                         "t.stl:4: a number is missing");
}

}  // namespace
}  // namespace patchlight::server
