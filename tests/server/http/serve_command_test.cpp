#include "server/http/socket_address.h"

#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_application.h"
#include "tests/server/http/test_service.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace patchlight::server::serve_command_test {
namespace {

/// The program `patchlight serve`, with its standard error in a file.
class ServingProgram {
  public:
    explicit ServingProgram(const std::vector<std::string>& options) {
        log_ = test_file(write_test_file("serve.log", ""));
        std::vector<std::string> words{PATCHLIGHT_PROGRAM, "serve", "--port", "0"};
        words.insert(words.end(), options.begin(), options.end());
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        process_ = ::fork();
        if (process_ == 0) {
            if (!std::freopen(log_.c_str(), "w", stderr)) ::_exit(127);
            ::execv(arguments.front(), arguments.data());
            ::_exit(127);
        }
        EXPECT_TRUE(eventually([&] { return port() > 0; })) << log();
    }

    ~ServingProgram() {
        if (process_ > 0) {
            ::kill(process_, SIGKILL);
            ::waitpid(process_, nullptr, 0);
        }
    }
    ServingProgram(const ServingProgram&) = delete;
    ServingProgram& operator=(const ServingProgram&) = delete;

    std::string log() const { return read_test_file("serve.log"); }

    /// From the line "listening on http://127.0.0.1:40123"; 0 while it is not there.
    int port() const {
        const std::string text = log();
        const std::size_t line = text.find("listening on http://");
        const std::size_t colon = text.find(':', line + 20);
        if (line == std::string::npos || text.find('\n', line) == std::string::npos) return 0;
        return std::atoi(text.c_str() + colon + 1);
    }

    pid_t process() const { return process_; }

    void send(int signal) const { ::kill(process_, signal); }

    /// Exit code, or minus the signal that killed it.
    int wait() {
        int status = 0;
        ::waitpid(process_, &status, 0);
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

  private:
    std::string log_;
    pid_t process_ = -1;
};

/// One that has begun to solve for minutes.
std::unique_ptr<RawClient> begin_slow_render(const ServingProgram& program) {
    auto client = std::make_unique<RawClient>(program.port());
    client->send(post("/v1/render", slow_scene()));
    // With --queue 0 it is not ready while it solves.
    EXPECT_TRUE(eventually([&] { return ask(program.port(), get("/readyz")).status == 503; }));
    return client;
}

TEST(ServeCommand, ServesUntilItIsToldToEnd) {
    ServingProgram program({});
    EXPECT_EQ(ask(program.port(), get("/readyz")).status, 200);
    const std::string port = std::to_string(program.port());
    EXPECT_EQ(run_program("health --port " + port).code, 0);
    EXPECT_EQ(ask(program.port(), get("/a\"b\n")).status, 400);
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 0);
    const Outcome dead = run_program("health --port " + port);
    EXPECT_EQ(dead.code, 1);
    EXPECT_NE(dead.err.find("nothing listens"), std::string::npos) << dead.err;
    std::istringstream lines(program.log());
    std::string line;
    std::getline(lines, line);  // "listening on"
    while (std::getline(lines, line)) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
}

TEST(ServeCommand, LetsWhatRunsEndWithinItsGrace) {
    ServingProgram program({"--queue", "0", "--time-limit", "0.5", "--quiet"});
    const auto client = begin_slow_render(program);
    program.send(SIGTERM);
    const RawAnswer answer = client->answer();
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("patchlight-status"), "limit");
    EXPECT_EQ(program.wait(), 0);
}

TEST(ServeCommand, CancelsWhatRunsWhenTheGraceIsOver) {
    ServingProgram program({"--queue", "0", "--grace", "0.1", "--quiet"});
    const auto client = begin_slow_render(program);
    program.send(SIGTERM);
    const RawAnswer answer = client->answer();
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("patchlight-status"), "cancelled");
    EXPECT_EQ(program.wait(), 0);
}

TEST(ServeCommand, EndsAtOnceAtTheSecondSignal) {
    ServingProgram program({"--queue", "0"});
    const auto client = begin_slow_render(program);
    program.send(SIGTERM);
    EXPECT_TRUE(eventually([&] { return program.log().find("draining") != std::string::npos; }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 128 + SIGTERM);
}

TEST(ServeCommand, SaysThatItsPortIsTaken) {
    const Listener taken = listen_on("127.0.0.1", 0);
    const Outcome outcome = run_program("serve --port " + std::to_string(taken.port));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("in use"), std::string::npos) << outcome.err;
    ::close(taken.socket);
}

TEST(ServeCommand, MakesATokenWhereOthersCanConnect) {
    ::unsetenv("PATCHLIGHT_TOKEN");
    ServingProgram program({"--host", "0.0.0.0"});
    const std::string log = program.log();
    const std::size_t begin = log.find("Bearer ");
    ASSERT_NE(begin, std::string::npos) << log;
    const std::string token = log.substr(begin + 7, 32);
    EXPECT_EQ(ask(program.port(), post("/v1/render", quick_scene())).status, 401);
    EXPECT_EQ(ask(program.port(), get("/healthz")).status, 200);
    EXPECT_EQ(ask(program.port(),
                  post("/v1/render", "{}",
                       "Content-Type: application/json\r\nAuthorization: Bearer " + token + "\r\n"))
                  .status,
              422);
}

#if !defined(__SANITIZE_ADDRESS__)  // which takes all addresses there are
TEST(ServeCommand, OutlivesALackOfMemory) {
    constexpr rlim_t megabyte = 1 << 20;
    std::string large = "{\"version\": 1, \"objects\": [1";
    for (int k = 0; k < 8'000'000; ++k) large += ",1";
    large += "]}";
    ServingProgram program({"--quiet"});
    std::ifstream status("/proc/" + std::to_string(program.process()) + "/status");
    std::string line;
    while (std::getline(status, line) && !line.starts_with("VmSize:")) continue;
    const rlim_t present = std::stoul(line.substr(7)) / 1024;
    int refusals = 0;
    for (const rlim_t more : {60, 120, 180, 240, 300, 420, 900}) {
        const rlimit limit{(present + more) * megabyte, RLIM_INFINITY};
        ASSERT_EQ(::prlimit(program.process(), RLIMIT_AS, &limit, nullptr), 0);
        const int answered = ask(program.port(), post("/v1/render", large)).status;
        EXPECT_TRUE(answered == 503 || answered == 422 || answered == 500) << answered;
        refusals += answered == 503 ? 1 : 0;
        ASSERT_EQ(ask(program.port(), get("/healthz")).status, 200) << more << " MB more";
    }
    EXPECT_GT(refusals, 0);
    EXPECT_EQ(ask(program.port(), post("/v1/render", quick_scene())).status, 200);
}
#endif

TEST(ServeCommand, RefusesLimitsThatAreNoNumbers) {
    for (const char* limit : {"--time-limit nan", "--grace nan"}) {
        const Outcome outcome =
            run_program(std::string("serve --port 0 ") + limit, "timeout --preserve-status 5");
        EXPECT_EQ(outcome.code, 2) << limit;
        EXPECT_NE(outcome.err.find("must be a number, not 'nan'"), std::string::npos)
            << outcome.err;
    }
}

TEST(ServeCommand, RefusesOptionsThatWouldNotDo) {
    for (const char* options : {"--port 65536", "--port x", "--max-body 0", "--workers 0",
                                "--token-file none", "--time-limit 0", "--unknown"})
        EXPECT_EQ(run_program(std::string("serve ") + options).code, 2) << options;
    EXPECT_EQ(run_program("serve", "PATCHLIGHT_TOKEN=short").code, 2);
    EXPECT_EQ(run_program("serve --host no.such.host.invalid").code, 1);
}

}  // namespace
}  // namespace patchlight::server::serve_command_test
