#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::server::obj_names_test {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ImportedGeometry read(const std::string& text) { return read_written("thing.obj", text); }

double red(const ImportedGeometry& geometry, std::size_t k) {
    return geometry.materials.at(k).reflectance.value_or(Rgb::Constant(-1.0))[0];
}

/// 3ds Max calls its materials so (mrdoob/three.js#6682).
TEST(ObjNames, AHashBelongsToTheNameOfAMaterial) {
    write_test_file("a.mtl",
                    "# two\nnewmtl Material #25\nKd 0.2\nnewmtl Material #26\nKd 0.8 # pale\n"
                    "newmtl #27\nKd 0.3\n");
    const ImportedGeometry painted = read(
        "mtllib a.mtl\n" + square +
        "usemtl Material #25\nf 1 2 3\nusemtl Material #26\nf 1 2 3 # c\nusemtl #27\nf 1 2 3#");
    ASSERT_EQ(painted.materials.size(), 3u);
    EXPECT_EQ(painted.materials[0].name, "Material #25");
    EXPECT_EQ(red(painted, 0), 0.2);
    EXPECT_EQ(red(painted, 1), 0.8);
    EXPECT_EQ(red(painted, 2), 0.3);
}

TEST(ObjNames, AHashBelongsToTheNameOfAGroupAnObjectAndALibrary) {
    write_test_file("lib#1.mtl", "newmtl m\nKd 0.4\n");
    const ImportedGeometry house = read("mtllib lib#1.mtl\n" + square +
                                        "g wall#1\nusemtl m\nf 1 2 3\ng wall#2\nf 1 2 4\n"
                                        "o roof # 3\nf 2 3 4\n");
    ASSERT_EQ(house.parts.size(), 3u);
    EXPECT_EQ(house.parts[0].path, "wall#1");
    EXPECT_EQ(house.parts[1].path, "wall#2");
    EXPECT_EQ(house.parts[2].path, "roof # 3");
    EXPECT_EQ(red(house, 0), 0.4);
    EXPECT_TRUE(house.about_materials.empty());
}

TEST(ObjNames, ACommentBehindANameIsNoPartOfItWhereTheNameIsKnownWithout) {
    write_test_file("c.mtl", "newmtl red # of bricks\nKd 0.5\nnewmtl blue\nKd 0.1\n");
    const ImportedGeometry painted =
        read("mtllib c.mtl # colours\n" + square +
             "usemtl red\nf 1 2 3\nusemtl blue # of the sky\nf 1 2 3\n");
    EXPECT_EQ(red(painted, 0), 0.5);
    EXPECT_EQ(red(painted, 1), 0.1);
    EXPECT_TRUE(painted.about_materials.empty());
}

TEST(ObjNames, LinesMayEndInAnyWay) {
    const std::string mtl = "newmtl m\nKd 0.4 0.4 0.4\nKe 1 1 1\n";
    const std::string obj = "mtllib e.mtl\n" + square + "usemtl m\nf 1 2 \\\n 3 4\n";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const auto ended = [&](const std::string& text) {
            std::string result;
            for (const char letter : text) result += letter == '\n' ? end : std::string(1, letter);
            return result;
        };
        write_test_file("e.mtl", ended(mtl));
        const ImportedGeometry painted = read("\xEF\xBB\xBF" + ended(obj));
        EXPECT_EQ(red(painted, 0), 0.4) << end.size();
        EXPECT_EQ(painted.parts[0].faces[0].count, 4u) << end.size();
        EXPECT_EQ(painted.parts[0].faces[0].line, 7u) << end.size();
    }
}

TEST(ObjNames, Utf16IsRefusedByName) {
    std::string wide;
    for (const char letter : "mtllib e.mtl\n" + square) wide += std::string(1, letter) + '\0';
    expect_file_rejected("thing.obj", "\xFF\xFE" + wide, "UTF-16");
    expect_file_rejected("thing.obj", wide, "UTF-16");
}

bool lets_light_through(const std::string& statements) {
    write_test_file("g.mtl", "newmtl m\nKd 0.5 0.5 0.5\n" + statements);
    return read("mtllib g.mtl\n" + square + "usemtl m\nf 1 2 3 4\n").materials[0].is_transparent;
}

/// tinyobjloader#43, three.js#12861, CloudCompare#1059.
TEST(MtlTransparency, IsNoticedHoweverItIsWritten) {
    for (const char* glass :
         {"d 0.3\n", "d -halo 0.3\n", "Tr 0.9\n", "tr 0.9\n", "Tf 0.9 0.9 0.9\n", "Tf 1 1 1\n",
          "Tf xyz 0.5 0.5 0.5\n", "illum 4\n", "illum 9\nNi 1.5\n", "illum 6\n", "illum 7\n",
          "map_d holes.png\n", "map_D holes.png\n", "map_Tr holes.png\n", "d 1\nmap_d h.png\n"})
        EXPECT_TRUE(lets_light_through(glass)) << glass;
    for (const char* wall : {"", "d 1\n", "d 1.0\nTr 0.0\n", "d 1\nTr 1\n", "Tr 0\n", "illum 2\n",
                             "d 1\nTf 1 1 1\nillum 2\n", "illum 2\nTf 1 1 1\n", "Tf 0 0 0\n"})
        EXPECT_FALSE(lets_light_through(wall)) << wall;
}

TEST(MtlTextures, OptionsStandBeforeTheNameWhichMayHaveBlanks) {
    for (const char* statement :
         {"map_Kd a b#1.png", "map_kd -s 1 1 1 a b#1.png", "map_Kd -o 0.5 a b#1.png",
          "map_Kd -clamp on -mm 0 1 -t 1 2 a b#1.png", "map_Kd\ta b#1.png"}) {
        write_test_file("t.mtl", "newmtl m\n" + std::string(statement) + "\n");
        const ImportedGeometry painted = read("mtllib t.mtl\n" + square + "usemtl m\nf 1 2 3 4\n");
        ASSERT_TRUE(painted.materials[0].reflectance_texture) << statement;
        EXPECT_EQ(painted.materials[0].reflectance_texture->name, "a b#1.png") << statement;
    }
}

}  // namespace
}  // namespace patchlight::server::obj_names_test
