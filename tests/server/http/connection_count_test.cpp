#include "server/http/connection_count.h"

#include <gtest/gtest.h>

namespace patchlight::server::connection_count_test {
namespace {

TEST(ConnectionCount, OneAddressCannotTakeThemAll) {
    HttpLimits limits;
    limits.connections = 4;
    limits.connections_per_address = 2;
    limits.reserve = 1;
    ConnectionCount count(limits);
    EXPECT_EQ(count.enter("10.0.0.1"), Lane::normal);
    EXPECT_EQ(count.enter("10.0.0.1"), Lane::normal);
    EXPECT_EQ(count.enter("10.0.0.1"), Lane::reserve);
    EXPECT_EQ(count.enter("10.0.0.1"), Lane::refused);
    EXPECT_EQ(count.enter("10.0.0.2"), Lane::normal);
    count.leave("10.0.0.1", Lane::normal);
    EXPECT_EQ(count.enter("10.0.0.1"), Lane::normal);
    EXPECT_EQ(count.open(), 4U);
}

TEST(ConnectionCount, LoopbackHasNoLimitOfItsOwn) {
    HttpLimits limits;
    limits.connections = 4;
    limits.connections_per_address = 1;
    limits.reserve = 0;
    ConnectionCount count(limits);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(count.enter("127.0.0.1"), Lane::normal);
    EXPECT_EQ(count.enter("127.0.0.1"), Lane::refused);
    count.leave("127.0.0.1", Lane::refused);
    EXPECT_EQ(count.open(), 4U) << "what was refused was not counted";
}

}  // namespace
}  // namespace patchlight::server::connection_count_test
