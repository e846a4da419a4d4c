#include "server/http/hardened_server.h"

#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_application.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace patchlight::server::hardened_server_test {
namespace {

const std::string host = "Host: localhost\r\n";

/// The connection ends after the answer, so that what follows is not taken for a request.
void expect_refused(TestServer& server, const std::string& request, int status) {
    RawClient client(server.port());
    client.send(request);
    const RawAnswer answer = client.answer(request.starts_with("HEAD "));
    EXPECT_EQ(answer.status, status) << request.substr(0, 200);
    EXPECT_EQ(answer.field("content-type"), "application/problem+json");
    const auto document = nlohmann::json::parse(answer.body, nullptr, false);
    EXPECT_EQ(document.value("status", 0), status) << answer.body;
    EXPECT_EQ(answer.field("connection"), "close");
    EXPECT_EQ(answer.field("x-content-type-options"), "nosniff");
    client.half_close();
    EXPECT_TRUE(client.is_closed());
}

TEST(HardenedServer, AgreesWithItsLibraryOnWhereMembersAre) {
    EXPECT_TRUE(library_layout_matches());
}

TEST(HardenedServer, AnswersRequestAfterRequestOnOneConnection) {
    TestServer server;
    RawClient client(server.port());
    for (const char* body : {"one", "two", ""}) {
        client.send(post("/echo", body));
        const RawAnswer answer = client.answer();
        EXPECT_EQ(answer.status, 200);
        EXPECT_EQ(answer.body, body);
        EXPECT_EQ(answer.field("connection"), "");
        EXPECT_EQ(answer.field("server"), "");
        EXPECT_FALSE(answer.field("date").empty());
    }
}

TEST(HardenedServer, AnswersPipelinedRequestsInOrder) {
    TestServer server;
    RawClient client(server.port());
    client.send(post("/echo", "first") + post("/echo", "second") + get("/remote"));
    EXPECT_EQ(client.answer().body, "first");
    EXPECT_EQ(client.answer().body, "second");
    EXPECT_EQ(client.answer().body, "127.0.0.1");
}

TEST(HardenedServer, ReadsChunkedBodiesAndThenCloses) {
    TestServer server;
    RawClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\n" + host +
                "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n");
    const RawAnswer answer = client.answer();
    EXPECT_EQ(answer.body, "abcde");
    EXPECT_EQ(answer.field("connection"), "close");
}

TEST(HardenedServer, RefusesAmbiguousFraming) {
    TestServer server;
    const std::string line = "POST /echo HTTP/1.1\r\n" + host;
    for (const char* fields :
         {"Content-Length: 1\r\nContent-Length: 1\r\n", "Content-Length: 1, 1\r\n",
          "Content-Length: 1\r\nTransfer-Encoding: chunked\r\n", "Content-Length: abc\r\n",
          "Content-Length: -1\r\n", "Content-Length: +1\r\n", "Content-Length: 0x1\r\n",
          "Content-Length:\r\n", "Content-Length : 1\r\n", "Transfer-Encoding: gzip, chunked\r\n",
          "Transfer-Encoding: chunk%65d\r\n", "Transfer-Encoding: chunked, chunked\r\n",
          "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n", "X: a\r\n folded\r\n",
          "X: a\nY: b\r\n", "X: a\rb\r\n", "no colon\r\n", ": no name\r\n", "Host: twice\r\n"})
        expect_refused(server, line + fields + "\r\nx", 400);
    expect_refused(server, line + std::string("X: \0\r\n", 6) + "\r\n", 400);
    expect_refused(server, "POST /echo HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                   400);
    expect_refused(server, line + "Content-Length: 1000000000000\r\n\r\n", 413);
    expect_refused(server, line + "Content-Length: 99999999999999999999999\r\n\r\n", 413);
    EXPECT_EQ(server.application().answered, 0);
}

TEST(HardenedServer, RefusesBrokenChunks) {
    TestServer server(quick_limits());
    for (const char* chunks : {"-2\r\nab", "zz\r\nab\r\n0\r\n\r\n", "3\r\nabcX\r\n0\r\n\r\n",
                               "ffffffffffffffff\r\nab\r\n", "\r\n\r\n"}) {
        RawClient client(server.port());
        client.send("POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n" +
                    chunks);
        client.half_close();
        const int status = client.answer().status;
        EXPECT_GE(status, 400) << chunks;
        EXPECT_LT(status, 500) << chunks;
        EXPECT_TRUE(client.is_closed());
    }
    EXPECT_EQ(server.application().answered, 0);
}

TEST(HardenedServer, RefusesWhatIsNoHttp) {
    TestServer server(quick_limits());
    for (const char* request :
         {"hello\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/2.0\r\n\r\n", "GET / HTTP/1.1\r\n\r\n",
          "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", "GET /a b HTTP/1.1\r\n\r\n",
          "GET http://other/ HTTP/1.1\r\nHost: localhost\r\n\r\n", "G@T / HTTP/1.1\r\n\r\n",
          "GET /#x HTTP/1.1\r\nHost: localhost\r\n\r\n", "get\t/\tHTTP/1.1\r\n\r\n"})
        expect_refused(server, request, 400);
    // A client that wants to speak TLS gets some end, too.
    RawClient client(server.port());
    client.send(std::string("\x16\x03\x01\x00\xa5\x01\x00\x00\xa1\x03\x03\r\n\r\n", 15));
    EXPECT_NE(client.answer().status, 200);
    EXPECT_TRUE(client.is_closed());
}

TEST(HardenedServer, AsksTheApplicationAboutMethodsTheLibraryDoesNotKnow) {
    TestServer server;
    expect_refused(server, "FOO /echo HTTP/1.1\r\n" + host + "\r\n", 405);
}

TEST(HardenedServer, DoesNotTakeAnUnreadBodyForARequest) {
    TestServer server;
    RawClient client(server.port());
    const std::string smuggled = get("/remote");
    client.send("POST /refused HTTP/1.1\r\n" + host +
                "Content-Length: " + std::to_string(smuggled.size()) + "\r\n\r\n");
    const RawAnswer refused = client.answer();
    EXPECT_EQ(refused.status, 401);
    EXPECT_EQ(refused.field("connection"), "close");
    client.send(smuggled);
    EXPECT_EQ(client.answer().status, 0);
    EXPECT_EQ(server.application().answered, 0);
}

TEST(HardenedServer, SendsHeadOfTheAnswerToHeadAlone) {
    TestServer server;
    RawClient client(server.port());
    client.send("HEAD /remote HTTP/1.1\r\n" + host + "\r\n");
    const RawAnswer answer = client.answer(true);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("content-length"), "9");
    client.send(get("/remote"));
    EXPECT_EQ(client.answer().body, "127.0.0.1");
}

TEST(HardenedServer, MultipliesNothingForRangesOrCompression) {
    TestServer server;
    std::string ranges = "Range: bytes=0-";
    for (int k = 0; k < 200; ++k) ranges += ",0-";
    const RawAnswer answer =
        ask(server.port(), get("/large", ranges + "\r\nAccept-Encoding: br, gzip\r\n"));
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.body.size(), std::size_t{8} << 20);
    EXPECT_EQ(answer.field("content-encoding"), "");
}

TEST(HardenedServer, IgnoresRangesThatItDoesNotUnderstand) {
    TestServer server;
    for (const char* range : {"bytes=5-2", "lines=1-2", "bytes=0-0, -", "no range"}) {
        const RawAnswer answer =
            ask(server.port(), get("/remote", "Range: " + std::string(range) + "\r\n"));
        EXPECT_EQ(answer.status, 200) << range;
        EXPECT_EQ(answer.body, "127.0.0.1") << range;
    }
}

TEST(HardenedServer, HandsBodiesOnAsTheyAre) {
    TestServer server;
    const std::string part =
        "--x\r\nContent-Disposition: form-data; name=\"a\"; filename*=" + std::string(7900, 'f') +
        "\r\n\r\nbody\r\n--x--\r\n";
    for (const char* fields :
         {"Content-Encoding: gzip\r\n", "Content-Encoding: br\r\n",
          "Content-Type: multipart/form-data; boundary=x\r\n", "Content-Type: multipart/x\r\n",
          "Content-Type: application/x-www-form-urlencoded\r\n"}) {
        const RawAnswer answer = ask(server.port(), post("/echo", part + part, fields));
        EXPECT_EQ(answer.status, 200) << fields;
        EXPECT_EQ(answer.body, part + part) << fields;
    }
}

TEST(HardenedServer, ShowsNoExceptionToTheClient) {
    TestServer server;
    for (const std::string path : {"/throw", "/throw-number"})
        for (const std::string& request : {get(path), post(path, "body")}) {
            const RawAnswer answer = ask(server.port(), request);
            EXPECT_EQ(answer.status, 500);
            EXPECT_EQ(answer.body.find("secret"), std::string::npos);
            EXPECT_EQ(answer.field("exception_what"), "");
        }
    ASSERT_EQ(server.application().failures().size(), 4U);
    EXPECT_EQ(server.application().failures().front(), "secret of /srv/path");
    EXPECT_EQ(ask(server.port(), get("/remote")).status, 200);
}

TEST(HardenedServer, KnowsThePeerByItsSocketAlone) {
    TestServer server;
    EXPECT_EQ(ask(server.port(), get("/remote", "REMOTE_ADDR: 9.9.9.9\r\n")).body, "127.0.0.1");
}

TEST(HardenedServer, TakesAnIdFromTheClientOnlyIfItIsPlain) {
    TestServer server;
    const auto id_for = [&](const std::string& sent) {
        return ask(server.port(), get("/remote", "X-Request-Id: " + sent + "\r\n"))
            .field("x-request-id");
    };
    EXPECT_EQ(id_for("a.b_c-9"), "a.b_c-9");
    for (const std::string bad : {"a b", "a%0d%0aSet-Cookie: x", "<script>", "\xff"})
        EXPECT_EQ(id_for(bad).size(), 16U) << bad;
    EXPECT_EQ(id_for(std::string(65, 'a')).size(), 16U);
}

TEST(HardenedServer, SaysContinueWhenTheBodyIsWanted) {
    TestServer server;
    const std::string fields = host + "Content-Length: 2\r\nExpect: 100-continue\r\n\r\n";
    RawClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\n" + fields);
    EXPECT_EQ(client.answer().status, 100);
    client.send("ab");
    EXPECT_EQ(client.answer().body, "ab");
    RawClient other(server.port());
    other.send("POST /refused HTTP/1.1\r\n" + fields);
    EXPECT_EQ(other.answer().status, 401);
    expect_refused(server, "POST /echo HTTP/1.1\r\n" + host + "Expect: magic\r\n\r\n", 417);
}

TEST(HardenedServer, ClosesWhenTheClientWantsIt) {
    TestServer server;
    for (const std::string& request :
         {get("/remote", "Connection: close\r\n"), get("/remote", "Connection: x, Close\r\n"),
          std::string("GET /remote HTTP/1.0\r\n\r\n")}) {
        RawClient client(server.port());
        client.send(request);
        EXPECT_EQ(client.answer().field("connection"), "close");
        EXPECT_TRUE(client.is_closed());
    }
}

TEST(HardenedServer, SeesThatItsPeerHasGone) {
    TestServer server;
    for (const bool with_reset : {false, true}) {
        RawClient client(server.port());
        client.send(get("/wait"));
        ASSERT_TRUE(eventually([&] { return server.application().waiting == 1; }));
        if (with_reset)
            client.reset();
        else
            client.half_close();
        EXPECT_TRUE(eventually([&] { return server.application().waiting == 0; }));
    }
}

}  // namespace
}  // namespace patchlight::server::hardened_server_test
