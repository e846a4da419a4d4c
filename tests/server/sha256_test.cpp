#include "server/sha256.h"

#include <gtest/gtest.h>

namespace patchlight::server::sha256_test {
namespace {

// NIST, "Secure Hash Standard", FIPS 180-4, examples.
TEST(Sha256, PublishedExamples) {
    Sha256 nothing;
    EXPECT_EQ(nothing.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    Sha256 abc;
    abc.add("a");
    abc.add("bc");
    EXPECT_EQ(abc.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, NumbersAreLittleEndian) {
    Sha256 of_number;
    of_number.add(1.0);  // 0x3FF0000000000000
    Sha256 of_bytes;
    of_bytes.add(std::string_view("\0\0\0\0\0\0\xF0\x3F", 8));
    EXPECT_EQ(of_number.hex(), of_bytes.hex());
}

}  // namespace
}  // namespace patchlight::server::sha256_test
