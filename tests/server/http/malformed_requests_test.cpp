#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_application.h"
#include "tests/server/http/test_service.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace patchlight::server::malformed_requests_test {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool memory_is_measured = false;  // the sanitizer keeps what is freed
#else
constexpr bool memory_is_measured = true;
#endif

double resident_megabytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
    return 0.0;
}

/// Valid requests, and what chance makes of them.
class Mutations {
  public:
    explicit Mutations(unsigned seed) : random_(seed) {}

    std::string next() {
        if (below(2) == 0) return changed(valid());
        return post("/v1/render", changed(quick_scene()));  // the scene is broken, not the request
    }

  private:
    std::size_t below(std::size_t end) { return random_() % std::max<std::size_t>(end, 1); }

    std::string changed(std::string text) {
        const std::size_t changes = 1 + below(4);
        for (std::size_t k = 0; k < changes; ++k) change(text);
        return text;
    }

    std::string valid() {
        const std::string chunked =
            "POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            "Transfer-Encoding: chunked\r\n\r\n";
        switch (below(4)) {
            case 0:
                return get("/healthz", "Accept: */*\r\nX-Request-Id: a\r\n");
            case 1:
                return chunked + "5\r\n{\"ver\r\n0\r\n\r\n";
            default:
                return post("/v1/render?exposure=1", quick_scene());
        }
    }

    void change(std::string& request) {
        const std::size_t place = below(request.size());
        switch (below(7)) {
            case 0:
                request.resize(place);
                break;
            case 1:
                if (!request.empty()) request[place] ^= static_cast<char>(1U << below(8));
                break;
            case 2:
                request.insert(place, std::string(1 + below(20'000), 'A'));
                break;
            case 3:
                request.insert(place, std::string(1, static_cast<char>(below(256))));
                break;
            case 4:
                request.erase(place, below(40));
                break;
            case 5:
                request.insert(place, request.substr(below(request.size()), below(200)));
                break;
            default:
                replace_a_number(request, place);
        }
    }

    void replace_a_number(std::string& request, std::size_t place) {
        const std::size_t digit = request.find_first_of("0123456789", place);
        if (digit == std::string::npos) return;
        const char* const numbers[] = {"-1", "1e308", "99999999999", "0", "1e-320", "NaN", "2.5"};
        request.replace(digit, 1, numbers[below(7)]);
    }

    std::mt19937 random_;
};

/// None, or that of the first answer. A client that closes its end is not solved for, so it waits
/// a little: what is whole is answered by then, what is not would take until the time-out.
int status_after(int port, const std::string& request) {
    constexpr std::chrono::milliseconds a_little{15};
    RawClient client(port);
    if (client.send(request) && !client.receives_within(a_little)) client.half_close();
    return client.answer().status;
}

/// How often each status came.
using Tally = std::map<int, int>;

/// Sends requests from several clients at a time.
Tally send_mutations(int port, unsigned seed, int count) {
    constexpr int clients = 4;
    std::array<Tally, clients> tallies;
    std::vector<std::thread> threads;
    for (int k = 0; k < clients; ++k)
        threads.emplace_back([&, k] {
            Mutations mutations(seed + static_cast<unsigned>(k));
            for (int sent = 0; sent < count / clients; ++sent) {
                const std::string request = mutations.next();
                const int status = status_after(port, request);
                ++tallies[static_cast<std::size_t>(k)][status];
                EXPECT_LT(status, 500) << request.substr(0, 2000);
            }
        });
    Tally all;
    for (int k = 0; k < clients; ++k) {
        threads[static_cast<std::size_t>(k)].join();
        for (const auto& [status, often] : tallies[static_cast<std::size_t>(k)])
            all[status] += often;
    }
    return all;
}

TEST(MalformedRequests, AreAnsweredOrCutOffAndLeaveNothingBehind) {
    ServiceSettings settings;
    settings.http = quick_limits();
    settings.render.seconds = 0.05;
    settings.render.patches = 200;
    settings.render.pixels = 10'000;
    TestService service(settings);
    constexpr unsigned seed = 20240229;
    send_mutations(service.port(), seed, 500);  // what is loaded once is there after these
    const double before = resident_megabytes();
    Tally tally = send_mutations(service.port(), seed + 100, 1500);
    for (const int status : {200, 400, 404, 422}) {
        EXPECT_GT(tally[status], 0) << status << ": the requests are not what they should be";
    }
    EXPECT_EQ(ask(service.port(), get("/healthz")).status, 200);
    EXPECT_EQ(ask(service.port(), post("/v1/render", quick_scene())).status, 200);
    if (memory_is_measured) {
        EXPECT_LT(resident_megabytes(), before + 20);
    }
}

TEST(MalformedRequests, OversizedBodiesCostNoMemory) {
    ServiceSettings settings;
    settings.http.body_bytes = 1 << 20;
    TestService service(settings);
    ask(service.port(), get("/healthz"));
    const double before = resident_megabytes();
    for (int k = 0; k < 5; ++k) {
        RawClient client(service.port());
        client.send(
            "POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
            "Transfer-Encoding: chunked\r\n\r\n");
        const std::string chunk = "100000\r\n" + std::string(1 << 20, 'x') + "\r\n";
        for (int sent = 0; sent < 64 && client.send(chunk);) ++sent;
        const int status = client.answer().status;
        EXPECT_TRUE(status == 413 || status == 0) << status;
    }
    if (memory_is_measured) {
        EXPECT_LT(resident_megabytes(), before + 10);
    }
}

}  // namespace
}  // namespace patchlight::server::malformed_requests_test
