#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_application.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace patchlight::server::connection_limits_test {
namespace {

const std::string begun_post = "POST /echo HTTP/1.1\r\nHost: localhost\r\n";

/// Sends `piece` again and again until the server no longer takes it; whether it ever did so.
bool ends_in_time(RawClient& client, const std::string& piece, std::size_t most_bytes) {
    for (std::size_t sent = 0; sent < most_bytes; sent += piece.size())
        if (!client.send(piece)) return true;
    return client.is_closed();
}

TEST(ConnectionLimits, LongLinesAndManyFieldsAreRefused) {
    TestServer server;
    const int port = server.port();
    EXPECT_EQ(ask(port, get("/" + std::string(9000, 'a'))).status, 414);
    EXPECT_EQ(ask(port, get("/", "X: " + std::string(9000, 'a') + "\r\n")).status, 431);
    std::string fields;
    for (int k = 0; k < 100; ++k) fields += "X-" + std::to_string(k) + ": 1\r\n";
    EXPECT_EQ(ask(port, get("/", fields)).status, 431) << "with Host they are 101";
    std::string heavy;
    for (int k = 0; k < 10; ++k) heavy += "X: " + std::string(7000, 'a') + "\r\n";
    EXPECT_EQ(ask(port, get("/", heavy)).status, 431);
    EXPECT_EQ(ask(port, get("/" + std::string(7900, 'a'))).status, 200) << "long, but not too long";
}

TEST(ConnectionLimits, ALineWithoutEndIsCutOff) {
    TestServer server;
    RawClient client(server.port());
    client.send("GET /");
    EXPECT_TRUE(ends_in_time(client, std::string(1 << 20, 'a'), std::size_t{96} << 20));
}

TEST(ConnectionLimits, LargeBodiesAreRefusedHoweverTheyCome) {
    TestServer server(quick_limits());
    EXPECT_EQ(ask(server.port(), begun_post + "Content-Length: 1048577\r\n\r\n").status, 413);
    RawClient client(server.port());
    client.send(begun_post + "Transfer-Encoding: chunked\r\n\r\n");
    const std::string chunk = "10000\r\n" + std::string(65536, 'x') + "\r\n";
    for (int k = 0; k < 20; ++k) client.send(chunk);
    EXPECT_EQ(client.answer().status, 413);
    EXPECT_EQ(server.application().answered, 0);
    const std::string most(1 << 20, 'y');
    EXPECT_EQ(ask(server.port(), post("/echo", most)).body, most);
}

TEST(ConnectionLimits, ChunksOfNothingButSizesAreRefused) {
    TestServer server(quick_limits());
    RawClient client(server.port());
    client.send(begun_post + "Transfer-Encoding: chunked\r\n\r\n");
    std::string sizes;
    for (int k = 0; k < 10'000; ++k) sizes += "1;" + std::string(30, 'e') + "\r\nx\r\n";
    EXPECT_TRUE(ends_in_time(client, sizes, std::size_t{16} << 20));
    EXPECT_EQ(server.application().answered, 0);
}

TEST(ConnectionLimits, BodiesTogetherHaveALimitToo) {
    HttpLimits limits = quick_limits();
    limits.all_body_bytes = 100'000;
    TestServer server(limits);
    EXPECT_EQ(ask(server.port(), post("/echo", std::string(100'001, 'x'))).status, 503);
    EXPECT_EQ(ask(server.port(), post("/echo", std::string(100'000, 'x'))).status, 200);
}

TEST(ConnectionLimits, ABodyThatStallsIsGivenUp) {
    TestServer server(quick_limits());
    RawClient client(server.port());
    client.send(begun_post + "Content-Length: 10\r\n\r\nabc");
    const RawAnswer answer = client.answer();
    EXPECT_EQ(answer.status, 408);
    EXPECT_EQ(answer.field("connection"), "close");
}

TEST(ConnectionLimits, AByteNowAndThenBuysNoTime) {
    TestServer server(quick_limits());
    RawClient slow_head(server.port());
    RawClient slow_body(server.port());
    slow_body.send(begun_post + "Content-Length: 1000\r\n\r\n");
    const std::string head = "GET / HTTP/1.1\r\nHost: " + std::string(20, 'h');
    for (int k = 0; k < 10; ++k) {
        slow_head.send(head.substr(static_cast<std::size_t>(k), 1));
        slow_body.send("x");
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_EQ(slow_head.answer().status, 408);
    EXPECT_EQ(slow_body.answer().status, 408);
}

TEST(ConnectionLimits, SilentClientsKeepNobodyWaiting) {
    HttpLimits limits;  // the product's own: silence lasts for seconds
    TestServer server(limits);
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int k = 0; k < 50; ++k) {
        idle.push_back(std::make_unique<RawClient>(server.port()));
        if (k % 2 == 0) idle.back()->send("GET /he");
    }
    ASSERT_TRUE(eventually([&] { return server.server().open_connections() == 50; }));
    EXPECT_EQ(ask(server.port(), get("/remote")).status, 200);
    EXPECT_EQ(server.server().open_connections() >= 50, true) << "they are still there";
}

TEST(ConnectionLimits, BeyondTheLastConnectionHealthIsAnsweredAndNothingElse) {
    TestServer server;
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int k = 0; k < 64; ++k) idle.push_back(std::make_unique<RawClient>(server.port()));
    ASSERT_TRUE(eventually([&] { return server.server().open_connections() == 64; }));
    EXPECT_EQ(ask(server.port(), get("/remote")).status, 503);
    EXPECT_EQ(ask(server.port(), get("/healthz")).status, 200);
    idle.clear();
    EXPECT_TRUE(eventually([&] { return ask(server.port(), get("/remote")).status == 200; }));
}

TEST(ConnectionLimits, BeyondTheReserveConnectionsAreRefusedAtOnce) {
    HttpLimits limits;
    limits.connections = 2;
    limits.reserve = 1;
    limits.reserve_time = std::chrono::milliseconds(60'000);
    TestServer server(limits);
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int k = 0; k < 3; ++k) idle.push_back(std::make_unique<RawClient>(server.port()));
    ASSERT_TRUE(eventually([&] { return server.server().open_connections() == 3; }));
    const RawAnswer answer = RawClient(server.port()).answer();
    EXPECT_EQ(answer.status, 503);
    EXPECT_EQ(answer.field("retry-after"), "1");
    server.server().abandon();
}

TEST(ConnectionLimits, ASilentClientInTheReserveIsSentAwaySoon) {
    HttpLimits limits = quick_limits();
    limits.connections = 0;
    TestServer server(limits);
    RawClient client(server.port());
    EXPECT_EQ(client.answer().status, 503);
    EXPECT_TRUE(client.is_closed());
}

TEST(ConnectionLimits, IdleConnectionsEnd) {
    TestServer server(quick_limits());
    RawClient client(server.port());
    client.send(get("/remote"));
    EXPECT_EQ(client.answer().status, 200);
    EXPECT_TRUE(client.is_closed());
}

TEST(ConnectionLimits, AClientThatTakesNothingIsGivenUp) {
    HttpLimits limits;
    limits.write_idle_time = std::chrono::milliseconds(200);
    TestServer server(limits);
    RawClient client(server.port());
    client.send(get("/large"));
    EXPECT_TRUE(eventually([&] { return !server.application().noted_statuses().empty(); }));
}

TEST(ConnectionLimits, StoppingDoesNotWaitForIdleConnections) {
    auto server = std::make_unique<TestServer>();
    RawClient client(server->port());
    client.send(get("/remote"));
    EXPECT_EQ(client.answer().status, 200);
    server.reset();
    EXPECT_TRUE(client.is_closed());
}

}  // namespace
}  // namespace patchlight::server::connection_limits_test
