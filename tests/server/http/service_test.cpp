#include "server/http/service.h"

#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_application.h"
#include "tests/server/http/test_service.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <vector>

namespace patchlight::server::service_test {
namespace {

const std::string json_body = "Content-Type: application/json\r\n";

RawAnswer render(TestService& service, const std::string& scene, const std::string& query = "",
                 const std::string& fields = "") {
    return ask(service.port(), post("/v1/render" + query, scene, json_body + fields));
}

/// Starts a solve that takes minutes, and waits until it runs.
std::unique_ptr<RawClient> slow_render(TestService& service) {
    auto client = std::make_unique<RawClient>(service.port());
    client->send(post("/v1/render", slow_scene()));
    EXPECT_TRUE(eventually([&] { return service.service().is_busy(); }));
    return client;
}

TEST(Service, GivesAPictureOfTheFirstCamera) {
    TestService service;
    const RawAnswer answer = render(service, quick_scene());
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.field("content-type"), "image/png");
    EXPECT_TRUE(answer.body.starts_with("\x89PNG"));
    EXPECT_EQ(static_cast<unsigned char>(answer.body.at(19)), 8U) << "width";
    EXPECT_EQ(answer.field("patchlight-status"), "converged");
    EXPECT_GT(std::stod(answer.field("patchlight-algebraic-bound")), 0.0);
    EXPECT_GT(std::stod(answer.field("patchlight-error-estimate")), 0.0);
    EXPECT_EQ(answer.field("access-control-allow-origin"), "");
}

TEST(Service, GivesWhatAcceptAsksFor) {
    TestService service;
    const RawAnswer exr = render(service, quick_scene(), "", "Accept: image/x-exr\r\n");
    EXPECT_EQ(exr.field("content-type"), "image/x-exr");
    EXPECT_TRUE(exr.body.starts_with("\x76\x2f\x31\x01"));
    const RawAnswer none = render(service, quick_scene(), "", "Accept: image/gif\r\n");
    EXPECT_EQ(none.status, 406);
    EXPECT_NE(none.body.find("image/x-exr"), std::string::npos) << "it lists what there is";
}

TEST(Service, GivesTheResultWithAPictureOfEachCamera) {
    TestService service;
    const RawAnswer answer = render(service, quick_scene(), "", "Accept: application/json\r\n");
    const auto result = nlohmann::json::parse(answer.body);
    EXPECT_EQ(result["status"], "converged");
    ASSERT_EQ(result["images"].size(), 2U);
    EXPECT_EQ(result["images"][1]["camera"], "aside");
    EXPECT_EQ(result["images"][1]["content_type"], "image/png");
    EXPECT_TRUE(result["images"][1]["data"].get<std::string>().starts_with("iVBORw0KGgo"));
    EXPECT_EQ(result["settings"]["solve"]["time_limit"], 30.0) << "capped by the server";
}

TEST(Service, TakesTheCameraAndTheExposureFromTheQuery) {
    TestService service;
    const RawAnswer answer = render(service, quick_scene(), "?camera=aside&exposure=-1.5",
                                    "Accept: application/json\r\n");
    const auto result = nlohmann::json::parse(answer.body);
    ASSERT_EQ(result["images"].size(), 1U);
    EXPECT_EQ(result["images"][0]["camera"], "aside");
    EXPECT_EQ(result["images"][0]["exposure"], -1.5);
}

TEST(Service, NamesAParameterThatIsWrong) {
    TestService service;
    for (const std::string query : {"camera=nobody", "exposure=nan", "exposure=1e9",
                                    "exposure=", "exposur=1", "camera=above&camera=aside"}) {
        const RawAnswer answer = render(service, quick_scene(), "?" + query);
        EXPECT_EQ(answer.status, 422) << query;
        EXPECT_EQ(nlohmann::json::parse(answer.body)["parameter"],
                  query.substr(0, query.find('=')));
    }
    EXPECT_EQ(render(service, quick_scene(), "?exposure=1", "Accept: image/x-exr\r\n").status, 422);
}

TEST(Service, TakesNothingButPlainJson) {
    TestService service;
    for (const std::string fields :
         {"", "Content-Type: text/plain\r\n", "Content-Type: application/x-www-form-urlencoded\r\n",
          "Content-Type: multipart/form-data; boundary=x\r\n",
          "Content-Type: application/json\r\nContent-Encoding: gzip\r\n"}) {
        const RawAnswer answer = ask(service.port(), post("/v1/render", quick_scene(), fields));
        EXPECT_EQ(answer.status, 415) << fields;
        EXPECT_EQ(answer.field("accept-post"), "application/json");
    }
    const RawAnswer curl = ask(service.port(), post("/v1/render", "{}", ""));
    EXPECT_NE(curl.body.find("-H 'Content-Type: application/json'"), std::string::npos);
}

TEST(Service, SaysWhatThereIsAndWhatIsNotBuiltYet) {
    TestService service;
    const int port = service.port();
    for (const char* path :
         {"/v1/jobs", "/v1/jobs/1/events", "/metrics", "/v1/openapi.json", "/"}) {
        const RawAnswer answer = ask(port, get(path));
        EXPECT_EQ(answer.status, 404) << path;
        EXPECT_NE(answer.body.find("not built yet"), std::string::npos) << path;
    }
    EXPECT_EQ(ask(port, get("/../etc/passwd")).status, 404);
    EXPECT_EQ(ask(port, get("/" + std::string(7900, 'x'))).status, 404);
    EXPECT_EQ(ask(port, post("/healthz", "x")).status, 405);
    const RawAnswer wrong_method = ask(port, get("/v1/render"));
    EXPECT_EQ(wrong_method.status, 405);
    EXPECT_EQ(wrong_method.field("allow"), "POST, OPTIONS");
    for (const std::string method : {"PUT", "DELETE", "PATCH", "TRACE", "CONNECT", "FOO"})
        EXPECT_EQ(ask(port, method + " /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n").status, 405);
    const RawAnswer options = ask(port, "OPTIONS /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(options.status, 204);
    EXPECT_EQ(options.field("allow"), "GET, HEAD, OPTIONS");
}

TEST(Service, AsksForItsToken) {
    ServiceSettings settings;
    settings.token = "0123456789abcdef";
    TestService service(settings);
    const int port = service.port();
    for (const std::string fields :
         {"", "Authorization: Bearer wrong\r\n", "Authorization: Basic 0123456789abcdef\r\n"}) {
        const RawAnswer answer = ask(port, post("/v1/render", "{}", json_body + fields));
        EXPECT_EQ(answer.status, 401);
        EXPECT_TRUE(answer.field("www-authenticate").starts_with("Bearer"));
    }
    EXPECT_EQ(ask(port, post("/v1/render?token=0123456789abcdef", "{}")).status, 401);
    EXPECT_EQ(ask(port, get("/unknown")).status, 401) << "strangers are not told what there is";
    EXPECT_EQ(ask(port, get("/healthz")).status, 200);
    EXPECT_EQ(ask(port, get("/readyz")).status, 200);
    EXPECT_EQ(
        render(service, quick_scene(), "", "Authorization: Bearer 0123456789abcdef\r\n").status,
        200);
}

TEST(Service, RefusesPagesFromElsewhere) {
    TestService service;
    const int port = service.port();
    EXPECT_EQ(ask(port, "GET /healthz HTTP/1.1\r\nHost: evil.example\r\n\r\n").status, 403);
    EXPECT_EQ(ask(port, get("/healthz", "Origin: https://evil.example\r\n")).status, 403);
    EXPECT_EQ(ask(port, get("/healthz", "Origin: null\r\n")).status, 403);
    EXPECT_EQ(ask(port, get("/healthz", "Origin: http://localhost\r\n")).status, 200);
}

TEST(Service, AnswersWithWhatThereIsWhenTheTimeIsOver) {
    ServiceSettings settings;
    settings.render.seconds = 0.2;
    TestService service(settings);
    const RawAnswer answer = render(service, slow_scene());
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("patchlight-status"), "limit");
    EXPECT_TRUE(answer.body.starts_with("\x89PNG"));
}

TEST(Service, StopsSolvingWhenNobodyWaitsForTheAnswer) {
    TestService service;
    for (const bool with_reset : {false, true}) {
        auto client = slow_render(service);
        if (with_reset)
            client->reset();
        else
            client.reset();
        EXPECT_TRUE(eventually([&] { return !service.service().is_busy(); }));
    }
}

TEST(Service, RefusesMoreThanItsQueueHolds) {
    ServiceSettings settings;
    settings.render.waiting = 1;
    TestService service(settings);
    const auto running = slow_render(service);
    RawClient waiting(service.port());
    waiting.send(post("/v1/render", quick_scene()));
    ASSERT_TRUE(eventually([&] { return ask(service.port(), get("/readyz")).status == 503; }));
    const RawAnswer refused = render(service, quick_scene());
    EXPECT_EQ(refused.status, 429);
    EXPECT_GE(std::stoi(refused.field("retry-after")), 1);
    EXPECT_EQ(ask(service.port(), get("/healthz")).status, 200) << "it is busy, not dead";
    running->reset();
    EXPECT_EQ(waiting.answer().status, 200) << "its turn has come";
}

TEST(Service, ForgetsAClientThatLeavesTheQueue) {
    ServiceSettings settings;
    settings.render.waiting = 1;
    TestService service(settings);
    const auto running = slow_render(service);
    {
        RawClient waiting(service.port());
        waiting.send(post("/v1/render", quick_scene()));
        ASSERT_TRUE(eventually([&] { return ask(service.port(), get("/readyz")).status == 503; }));
    }
    EXPECT_TRUE(eventually([&] { return ask(service.port(), get("/readyz")).status == 200; }));
}

TEST(Service, SolvesSideBySideIfItMay) {
    ServiceSettings settings;
    settings.render.at_once = 2;
    TestService service(settings);
    const auto slow = slow_render(service);
    EXPECT_EQ(render(service, quick_scene()).status, 200);
    EXPECT_TRUE(service.service().is_busy());
}

TEST(Service, DrainsAndThenCancels) {
    TestService service;
    const auto running = slow_render(service);
    service.service().drain();
    EXPECT_EQ(ask(service.port(), get("/healthz")).status, 200);
    EXPECT_EQ(ask(service.port(), get("/readyz")).status, 503);
    const RawAnswer refused = render(service, quick_scene());
    EXPECT_EQ(refused.status, 503);
    EXPECT_EQ(refused.field("retry-after"), "1");
    service.service().cancel();
    const RawAnswer answer = running->answer();
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("patchlight-status"), "cancelled");
}

}  // namespace
}  // namespace patchlight::server::service_test
