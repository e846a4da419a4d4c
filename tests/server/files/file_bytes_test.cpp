#include "server/files/file_bytes.h"

#include "server/files/geometry_file.h"
#include "solver/scene/input_error.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace patchlight::server::file_bytes_test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::string& path) {
    try {
        read_geometry_file(path, "shown");
    } catch (const InputError& error) {
        return error.pointer() + ": " + error.what();
    }
    return "not refused";
}

TEST(FileBytes, AreReadWhole) {
    const std::string bytes("a\0b\r\n", 5);
    write_test_file("bytes", bytes);
    EXPECT_EQ(read_file_bytes(test_file("bytes"), "bytes"), bytes);
}

TEST(FileBytes, WhatIsNoReadableFileIsRefused) {
    fs::create_directories(test_file("folder.obj"));
    mkfifo(test_file("pipe.obj").c_str(), 0600);
    EXPECT_EQ(refusal(test_file("folder.obj")), "shown: is a directory");
    EXPECT_EQ(refusal(test_file("pipe.obj")), "shown: is no regular file");
    EXPECT_EQ(refusal(test_file("none.obj")), "shown: cannot be read: No such file or directory");
    EXPECT_EQ(refusal(test_file("none.obj/x.obj")),
              "shown: cannot be read: No such file or directory");
    EXPECT_EQ(refusal(test_file("room.fbx")),
              "shown: is an FBX scene, which is not read; export it as glTF, with Blender for "
              "instance");
}

TEST(FileBytes, AFileBesideLiesInTheDirectoryOrBelow) {
    const fs::path file = test_file("scene.gltf");
    fs::create_directories(test_file("below"));
    const fs::path directory = fs::weakly_canonical(file).parent_path();
    EXPECT_EQ(file_beside(file, "a.bin"), directory / "a.bin");
    EXPECT_EQ(file_beside(file, "below/a.bin"), directory / "below/a.bin");
    EXPECT_EQ(file_beside(file, "below/../a.bin"), directory / "a.bin");
    EXPECT_FALSE(file_beside(file, "../a.bin"));
    EXPECT_FALSE(file_beside(file, "below/../../a.bin"));
    EXPECT_FALSE(file_beside(file, "/a.bin"));
    EXPECT_FALSE(file_beside(file, std::string("a\0b", 3)));
    std::error_code ignored;
    fs::create_directory_symlink("/", test_file("out"), ignored);
    EXPECT_FALSE(file_beside(file, "out/etc/passwd"));
}

}  // namespace
}  // namespace patchlight::server::file_bytes_test
