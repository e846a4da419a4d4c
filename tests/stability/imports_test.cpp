#include "solver/scene/input_error.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"
#include "tests/stability/judgement.h"

#include <cmath>

namespace patchlight::stability::imports_test {
namespace {

using server::expect_file_rejected;
using server::ImportedGeometry;
using server::read_written;
using server::write_test_file;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Imports, NumbersThatAreNoneAreRefusedWithTheirLine) {
    for (const char* number : {"nan", "inf", "-inf", "1e400", "1e30", "x"})
        expect_file_rejected("thing.obj",
                             "v 0 0 0\nv 1 0 0\nv 1 " + std::string(number) + " 0\nf 1 2 3\n",
                             "thing.obj:3");
    for (const char* line : {"Kd nan 0 0", "Kd 1e30 0 0", "Ke -1 0 0", "Ke inf 0 0"}) {
        write_test_file("bad.mtl", "newmtl m\n" + std::string(line) + "\n");
        EXPECT_THROW(read_written("thing.obj", "mtllib bad.mtl\n" + square + "f 1 2 3\n"),
                     InputError)
            << line;
    }
    judge_all_refused("C8", "thing.obj:1",
                      [] { read_written("thing.obj", "v nan 0 0\n" + square + "f 1 2 3\n"); });
}

TEST(Imports, FilesOfOtherProgramsAreReadWithWhatWasAssumedTold) {
    write_test_file("odd.mtl", "newmtl m\nKd 0.2 0.2 0.2\nv 0.2 0 0\nsharpness 60\nillum 2\n");
    int unread = 0;
    for (const char* face : {"f -4 -3 -2 -1", "f 1//2 2//2 3//2 4//2", "f 1/2/3 2/2/3 3/2/3",
                             "f 1/9 2/9 3/9 4/9", "s off\nusemtl m\nf 1 2 3 4"}) {
        const ImportedGeometry read =
            read_written("thing.obj", "mtllib odd.mtl gone.mtl\n" + square + face + "\n");
        unread += read.face_count() == 1 ? 0 : 1;
        EXPECT_EQ(read.about_materials.size(), 1u) << "gone.mtl";
    }
    for (const char* face : {"f 1 2 99", "f 1 2 -9", "f 0 1 2", "f 1 2"})
        expect_file_rejected("thing.obj", square + face + "\n", "thing.obj:5");
    judge_all("C9", unread, 0.0);
}

TEST(Imports, KdOfZeroIsBlackUnlessATexturePaints) {
    write_test_file("k.mtl", "newmtl black\nKd 0 0 0\nnewmtl carpet\nKd 0 0 0\nmap_Kd c.png\n");
    write_test_file("thing.obj",
                    "mtllib k.mtl\n" + square + "usemtl black\nf 1 2 3\nusemtl carpet\nf 1 3 4\n");
    const Scene scene = server::scene_of_file("thing.obj").scene;
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(server::findings_of(scene, "texture-ignored").size(), 1u);
    EXPECT_EQ(server::findings_of(scene, "default-material").size(), 1u);
    const auto reflectance = [&](std::size_t s) {
        return scene.materials[scene.surfaces[s].material].reflectance[0];
    };
    judge_all("C10", std::abs(reflectance(0) - 0.0) + std::abs(reflectance(1) - 0.5), 0.0);
}

}  // namespace
}  // namespace patchlight::stability::imports_test
