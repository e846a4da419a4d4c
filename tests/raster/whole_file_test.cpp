#include "raster/whole_file.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace patchlight::raster::whole_file_test {
namespace {

namespace fs = std::filesystem;

class InDirectory : public testing::Test {
  protected:
    InDirectory()
        : directory(fs::temp_directory_path() / ("whole-file-" + std::to_string(::getpid()))) {
        fs::create_directory(directory);
    }
    ~InDirectory() override { fs::remove_all(directory); }

    static std::string text_of(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::ptrdiff_t file_count() const {
        return std::distance(fs::directory_iterator(directory), fs::directory_iterator());
    }

    const fs::path directory;
};

using AWholeFile = InDirectory;

TEST_F(AWholeFile, IsThereOnceItIsCommitted) {
    {
        WholeFile file(directory / "table");
        file.write("one ");
        file.write("two");
        EXPECT_FALSE(fs::exists(directory / "table"));
        file.commit();
        EXPECT_EQ(text_of(directory / "table"), "one two");
    }
    EXPECT_EQ(text_of(directory / "table"), "one two");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(AWholeFile, LeavesNothingWithoutACommit) {
    std::ofstream(directory / "table") << "previous";
    {
        WholeFile file(directory / "table");
        file.write("half");
    }
    EXPECT_EQ(text_of(directory / "table"), "previous");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(AWholeFile, IsOverwrittenInPlaces) {
    WholeFile file(directory / "table");
    file.write("size ... 1 2 3");
    file.overwrite(5, "  3");
    file.write(" end");
    file.commit();
    EXPECT_EQ(text_of(directory / "table"), "size   3 1 2 3 end");
}

TEST_F(AWholeFile, NamesWhatCannotBeOpened) {
    try {
        const WholeFile file(directory / "absent" / "table");
        ADD_FAILURE() << "opened";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code().value(), ENOENT);
        EXPECT_NE(std::string(error.what()).find("table"), std::string::npos);
    }
}

}  // namespace
}  // namespace patchlight::raster::whole_file_test
