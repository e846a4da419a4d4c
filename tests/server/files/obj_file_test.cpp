#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

namespace patchlight::server::obj_file_test {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ImportedGeometry read(const std::string& text) { return read_written("thing.obj", text); }

void expect_rejected_text(const std::string& text, const std::string& words) {
    expect_file_rejected("thing.obj", text, words);
}

TEST(ObjFile, PolygonsStayPolygons) {
    const ImportedGeometry read_back = read(square + "v 0.5 0.5 0\nf 1 2 3 5 4\n");
    ASSERT_EQ(read_back.parts.size(), 1u);
    ASSERT_EQ(read_back.parts[0].faces.size(), 1u);
    EXPECT_EQ(read_back.parts[0].faces[0].count, 5u);
    EXPECT_EQ(read_back.corners, (std::vector<std::uint32_t>{0, 1, 2, 4, 3}));
}

TEST(ObjFile, AFaceMayHaveThousandsOfCorners) {
    std::string text;
    std::string face = "f";
    for (int k = 0; k < 3000; ++k) {
        const double angle = k * 2e-3;
        text +=
            "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
        face += " " + std::to_string(k + 1);
    }
    EXPECT_EQ(read(text + face).parts[0].faces[0].count, 3000u);
}

TEST(ObjFile, CornersComeInFourForms) {
    for (const char* face : {"f 1 2 3", "f 1/9 2/9 3/9", "f 1//7 2//7 3//7", "f 1/9/7 2/9/7 3/9/7",
                             "f -4 -3 -2", "f -4//-1 -3//-1 -2//-1", "f 1 2 \\\n 3", "fo 1 2 3"})
        EXPECT_EQ(read(square + face).corners, (std::vector<std::uint32_t>{0, 1, 2})) << face;
}

TEST(ObjFile, NegativeIndicesCountFromTheLineTheyStandOn) {
    const ImportedGeometry two = read(square + "f -4 -3 -2 -1\n" + square + "f -4 -3 -2 -1\n");
    EXPECT_EQ(two.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ObjFile, VerticesMayComeAfterTheirFaces) {
    EXPECT_EQ(read("f 1 2 3\n" + square).corners.size(), 3u);
}

TEST(ObjFile, ObjectsAndGroupsArePartsInTheOrderOfTheFile) {
    const ImportedGeometry house =
        read(square +
             "f 1 2 3\ng roof\nf 1 2 3\no house\nf 1 2 3\ng wall a\nf 1 2 3\ng empty\n"
             "o house\nf 1 2 4\ng roof\nf 2 3 4\no\ng roof\nf 1 3 4\n");
    std::vector<std::string> paths;
    std::vector<std::size_t> faces;
    for (const FilePart& part : house.parts) {
        paths.push_back(part.path);
        faces.push_back(part.faces.size());
    }
    EXPECT_EQ(paths, (std::vector<std::string>{"", "roof", "house", "house/wall a", "house/roof"}));
    EXPECT_EQ(faces, (std::vector<std::size_t>{1, 2, 2, 1, 1}));
}

TEST(ObjFile, WhatHasNoAreaIsPassedOver) {
    const ImportedGeometry plain =
        read("\xEF\xBB\xBF# hello\r\nmg 1 2\r\n" + square +
             "vn 0 0 1\nvt 0 0\ns off\nl 1 2\np 1\nlod 3\n\tf 1 2 3 # a comment\r\n");
    EXPECT_EQ(plain.face_count(), 1u);
    EXPECT_TRUE(plain.remarks.empty());
}

TEST(ObjFile, CurvedSurfacesAreRemarkedOn) {
    const ImportedGeometry curved =
        read(square + "f 1 2 3\ncstype bezier\nsurf 0 1 0 1 1 2 3 4\nend\n");
    ASSERT_EQ(curved.remarks.size(), 1u);
    EXPECT_EQ(curved.remarks[0].kind, "unsupported-geometry");
}

TEST(ObjFile, NumbersMayHaveAnySensibleForm) {
    const ImportedGeometry forms =
        read("v +1 -.5 1e-3\nv 1. 0 0 1\nv 0 1e-400 0 0.1 0.2 0.3\nf 1 2 3\n");
    EXPECT_EQ(forms.vertices[0], Vec3(1, -0.5, 1e-3));
    EXPECT_EQ(forms.vertices[2], Vec3(0, 0, 0));
}

TEST(ObjFile, IndicesMustExist) {
    expect_rejected_text(square + "\nf 1 2 3\nf 1 2 5\n",
                         "thing.obj:7: vertex 5 does not exist; there are 4");
    expect_rejected_text(square + "f 1 2 0\n", "thing.obj:5: a corner is a number from 1");
    expect_rejected_text(square + "f 1 2 -5\n", "thing.obj:5: vertex '-5' does not exist");
    expect_rejected_text("f -1 -2 -3\n" + square, "thing.obj:1: vertex '-1'");
    expect_rejected_text(square + "f 1 2 4294967297\n", "does not exist");
    expect_rejected_text(square + "f 1 2 99999999999999999999\n", "thing.obj:5: a corner is");
    for (const char* corner :
         {"x", "1.5", "1/x", "1/", "1//", "1/2/", "1/2/3/4", "//1", "1/0", "1 /2"})
        expect_rejected_text(square + "f 2 3 " + corner + "\n", "thing.obj:5: a corner is");
}

TEST(ObjFile, AFaceHasThreeCornersAtLeast) {
    expect_rejected_text(square + "f 1 2\n",
                         "thing.obj:5: a face must have at least 3 corners, not 2");
    expect_rejected_text(square + "f\n", "at least 3 corners, not 0");
}

TEST(ObjFile, CoordinatesMustBeFiniteNumbersInReach) {
    expect_rejected_text("v 0 nan 0\n", "thing.obj:1: must be a finite number, not 'nan'");
    expect_rejected_text("v 0 0 0\nv inf 0 0\n", "thing.obj:2: must be within");
    expect_rejected_text("v 0 0 1e30\n", "thing.obj:1: must be within ±1e+15, not '1e30'");
    expect_rejected_text("v 0 0 1e400\n", "must be within");
    expect_rejected_text("v 0 0\n", "thing.obj:1: a number is missing");
    expect_rejected_text("v 0 0 0x10\n", "must be a number, not '0x10'");
}

TEST(ObjFile, WhatIsNoObjIsRefused) {
    expect_rejected_text("", "has no faces");
    expect_rejected_text(square, "has no faces");
    expect_rejected_text("{\"version\": 1}", "thing.obj:1: unknown statement '{\"version\":'");
    expect_rejected_text(std::string("\0\1\2\3", 4), "unknown statement");
    expect_rejected_text("o " + std::string(1000, 'x') + "\nf 1 2 3",
                         "thing.obj:1: a name of more");
}

TEST(ObjFile, MaterialsComeFromMtlFiles) {
    write_test_file("a.mtl",
                    "newmtl red paint\n Kd 0.6 0.1 0.05\nKs 1 1 1\nfoo bar\nillum 2\n\tKe 1 2 3\n"
                    "newmtl grey\nKd 0.5\nnewmtl wood\nKd 0.4 0.3 0.2\nmap_Kd -s 1 1 1 wood.png\n"
                    "newmtl glass\nKd 0.1 0.1 0.1\nd 0.3\nnewmtl odd\nNs 7\n");
    const ImportedGeometry painted =
        read("mtllib a.mtl\n" + square +
             "usemtl red paint\nf 1 2 3\nusemtl grey\nf 1 2 3\nusemtl wood\nf 1 2 3\n"
             "usemtl glass\nf 1 2 3\nusemtl odd\nf 1 2 3\nusemtl nowhere\nf 1 2 3\nusemtl grey\nf "
             "1 2 4\n");
    ASSERT_EQ(painted.materials.size(), 6u);
    EXPECT_EQ(painted.materials[0].name, "red paint");
    EXPECT_TRUE((*painted.materials[0].reflectance == Rgb(0.6, 0.1, 0.05)).all());
    EXPECT_TRUE((painted.materials[0].radiance == Rgb(1, 2, 3)).all());
    EXPECT_TRUE((*painted.materials[1].reflectance == 0.5).all());
    ASSERT_TRUE(painted.materials[2].reflectance_texture);
    EXPECT_EQ(painted.materials[2].reflectance_texture->name, "wood.png");
    EXPECT_TRUE(painted.materials[3].is_transparent);
    EXPECT_FALSE(painted.materials[4].reflectance);
    EXPECT_FALSE(painted.materials[5].reflectance);
    EXPECT_EQ(painted.parts[0].faces.back().material, 1u);
}

TEST(ObjFile, KdOfZeroIsBlackUnlessATexturePaints) {
    write_test_file("k.mtl",
                    "newmtl black\nKd 0 0 0\nnewmtl carpet\nmap_Kd c.png\nKd 0 0 0\n"
                    "newmtl glow\nKd 0\nmap_Ke g.png\n");
    const ImportedGeometry painted =
        read("mtllib k.mtl\n" + square +
             "usemtl black\nf 1 2 3\nusemtl carpet\nf 1 2 3\nusemtl glow\nf 1 2 3\n");
    ASSERT_EQ(painted.materials.size(), 3u);
    EXPECT_TRUE((painted.materials[0].reflectance.value() == 0.0).all());
    EXPECT_FALSE(painted.materials[1].reflectance);
    EXPECT_TRUE((painted.materials[2].reflectance.value() == 0.0).all());
}

TEST(ObjFile, AnMtlFileIsFoundBesideTheObjWhateverFolderIsNamed) {
    write_test_file("b c.mtl", "newmtl m\nKd 0.3 0.3 0.3\n");
    for (const char* name :
         {"b c.mtl", "scenes/b c.mtl", "C:\\models\\b c.mtl", "/no/such/b c.mtl"}) {
        const ImportedGeometry found =
            read("mtllib " + std::string(name) + "\n" + square + "usemtl m\nf 1 2 3\n");
        EXPECT_TRUE(found.materials[0].reflectance.has_value()) << name;
        EXPECT_TRUE(found.about_materials.empty()) << name;
    }
}

TEST(ObjFile, AMissingMtlFileIsRemarkedOn) {
    const ImportedGeometry lacking =
        read("mtllib none.mtl ../none.mtl\n" + square + "usemtl m\nf 1 2 3\n");
    ASSERT_EQ(lacking.about_materials.size(), 2u);
    EXPECT_EQ(lacking.about_materials[0].kind, "missing-material-file");
    EXPECT_NE(lacking.about_materials[0].detail.find("'none.mtl'"), std::string::npos);
}

TEST(ObjFile, MistakesInAnMtlFileAreToldWithItsLine) {
    const auto expect_mtl_rejected = [](const std::string& mtl, const std::string& words) {
        write_test_file("bad.mtl", mtl);
        try {
            read("mtllib bad.mtl\n" + square + "f 1 2 3\n");
            ADD_FAILURE() << "accepted: " << mtl;
        } catch (const InputError& error) {
            EXPECT_EQ(error.pointer() + ": " + error.what(), words);
        }
    };
    expect_mtl_rejected("newmtl m\nKd -0.1 0 0\n", "bad.mtl:2: must be at least 0");
    expect_mtl_rejected("newmtl m\nKe 0 -1 0\n", "bad.mtl:2: must be at least 0");
    expect_mtl_rejected("newmtl m\nKd 0 nan 0\n", "bad.mtl:2: must be a finite number, not 'nan'");
    expect_mtl_rejected("newmtl m\nKe 0 0 1e30\n", "bad.mtl:2: must be within ±1e+15, not '1e30'");
    expect_mtl_rejected("newmtl m\n\nKd red\n", "bad.mtl:3: must be a number, not 'red'");
    expect_mtl_rejected("newmtl m\nKd 0.1 0.2\n", "bad.mtl:2: a number is missing");
    expect_mtl_rejected("newmtl m\nKd spectral x.rfl 1\n",
                        "bad.mtl:2: colours are read as r g b only, not as 'spectral x.rfl 1'");
    expect_mtl_rejected("newmtl\n", "bad.mtl:1: 'newmtl' needs a name");
    expect_mtl_rejected("Kd 1 1 1\n", "bad.mtl:1: 'Kd' stands before any 'newmtl'");
}

}  // namespace
}  // namespace patchlight::server::obj_file_test
