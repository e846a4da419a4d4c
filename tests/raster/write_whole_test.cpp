#include "raster/write_whole.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>

namespace patchlight::raster::write_whole_test {
namespace {

namespace fs = std::filesystem;

/// An empty directory for each test.
class WriteWhole : public testing::Test {
  protected:
    WriteWhole() : directory(fs::temp_directory_path() / unique_name()) {
        fs::create_directory(directory);
    }
    ~WriteWhole() override { fs::remove_all(directory); }

    static std::string unique_name() {
        return "write-whole-" + std::to_string(::getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name();
    }
    static std::string text_of(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::ptrdiff_t file_count() const {
        return std::distance(fs::directory_iterator(directory), fs::directory_iterator());
    }
    /// errno of the failure, 0 if there is none.
    static int failure(const fs::path& path, std::string_view bytes) {
        try {
            write_whole(path, bytes);
        } catch (const std::system_error& error) {
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
            return error.code().value();
        }
        return 0;
    }

    const fs::path directory;
};

/// Files may not grow past a limit meanwhile, as if the disk were full.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) : ignored_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, ignored_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

  private:
    rlimit before_{};
    void (*ignored_)(int);
};

TEST_F(WriteWhole, WritesAllBytes) {
    const std::string bytes("a\0b\n\xff", 5);
    write_whole(directory / "new", bytes);
    EXPECT_EQ(text_of(directory / "new"), bytes);
    write_whole(directory / "new", "shorter");
    EXPECT_EQ(text_of(directory / "new"), "shorter");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(WriteWhole, OnAFullDiskThePreviousFileStaysAndNothingElseIsLeft) {
    write_whole(directory / "picture", "previous");
    int reason = 0;
    {
        const SmallDisk disk(1000);
        reason = failure(directory / "picture", std::string(100000, 'x'));
    }
    EXPECT_EQ(reason, EFBIG);
    EXPECT_EQ(text_of(directory / "picture"), "previous");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(WriteWhole, NamesWhatIsInTheWay) {
    EXPECT_EQ(failure(directory / "absent" / "picture", "x"), ENOENT);
    EXPECT_EQ(failure(directory, "x"), EISDIR);
    write_whole(directory / "file", "x");
    EXPECT_EQ(failure(directory / "file" / "picture", "x"), ENOTDIR);
    EXPECT_EQ(failure("/dev/full", "x"), ENOSPC);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(WriteWhole, WritesBehindALinkAndKeepsIt) {
    write_whole(directory / "file", "before");
    fs::create_symlink("file", directory / "link");
    write_whole(directory / "link", "after");
    EXPECT_TRUE(fs::is_symlink(directory / "link"));
    EXPECT_EQ(text_of(directory / "file"), "after");
}

TEST_F(WriteWhole, ADeviceStaysADevice) {
    write_whole("/dev/null", "x");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteWhole, WritesIntoAPipe) {
    const fs::path pipe = directory / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] { read = text_of(pipe); });
    write_whole(pipe, std::string(200000, 'x'));
    reader.join();
    EXPECT_EQ(read.size(), 200000U);
}

TEST_F(WriteWhole, ReadersAndWritersAtOnceNeverSeeHalfAFile) {
    const fs::path path = directory / "shared";
    write_whole(path, std::string(50000, 'a'));
    const auto rewrite = [&](char letter) {
        for (int i = 0; i < 20; ++i) write_whole(path, std::string(50000, letter));
    };
    std::thread one(rewrite, 'b');
    std::thread other(rewrite, 'c');
    for (int i = 0; i < 50; ++i) {
        const std::string seen = text_of(path);
        EXPECT_EQ(seen, std::string(50000, seen.front()));
    }
    one.join();
    other.join();
    EXPECT_EQ(file_count(), 1);
}

}  // namespace
}  // namespace patchlight::raster::write_whole_test
