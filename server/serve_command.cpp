#include "server/serve_command.h"

#include "raster/image_module.h"
#include "server/http/access_token.h"
#include "server/http/machine_memory.h"
#include "server/http/service.h"
#include "server/http/socket_address.h"
#include "server/stop_signals.h"
#include "server/wording.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

namespace patchlight::server {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr const char* limits_group = "Limits (of each request, where nothing else is said)";

std::string url_of(const std::string& host, int port) {
    const bool is_six = host.find(':') != std::string::npos;
    return "http://" + (is_six ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

/// A service in a thread of its own, which is stopped and waited for whatever happens.
class RunningService {
  public:
    RunningService(Service& service, int socket)
        : service_(service), thread_([&service, socket] { service.run(socket); }) {}
    ~RunningService() {
        constexpr milliseconds patience{2000};  // for answers that are on their way
        service_.stop(patience);
        thread_.join();
    }
    RunningService(const RunningService&) = delete;
    RunningService& operator=(const RunningService&) = delete;

  private:
    Service& service_;
    std::thread thread_;
};

/// Lets what runs end, or stops it when `grace` is over.
void wind_down(Service& service, milliseconds grace) {
    constexpr milliseconds slice{20};
    service.drain();
    const Clock::time_point end = Clock::now() + grace;
    while (service.is_busy() && Clock::now() < end) std::this_thread::sleep_for(slice);
    service.cancel();
}

/// CLI::Range lets NaN through.
CLI::Validator a_number() {
    const auto check = [](const std::string& text) {
        double number = 0.0;
        const bool is_right = CLI::detail::lexical_cast(text, number) && !std::isnan(number);
        return is_right ? std::string() : "must be a number, not " + in_quotes(text);
    };
    return CLI::Validator(check, "", "");
}

}  // namespace

CLI::App* ServeCommand::add_to(CLI::App& program) {
    CLI::App* command = program.add_subcommand("serve", "Answer HTTP: scenes in, pictures out");
    command->add_option("--host", settings_.host, "address to listen on")
        ->type_name("ADDRESS")
        ->capture_default_str();
    command->add_option("--port", port_, "to listen on; 0 for a free one")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(0, 65535).description(""));
    command
        ->add_option("--token-file", token_file_,
                     "its first line is the token clients have to show; else it is taken from the "
                     "environment, PATCHLIGHT_TOKEN")
        ->type_name("FILE");
    command
        ->add_option("--allow-host", settings_.allowed_hosts,
                     "a name the server is reached by; may repeat")
        ->type_name("NAME")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--threads", settings_.threads, "that a solve uses; all cores if not given")
        ->type_name("N")
        ->check(CLI::Range(1, 1024).description(""));
    command->add_option("--grace", grace_, "seconds that running solves get when it is told to end")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(0.0, 86400.0).description(""))
        ->check(a_number());
    command->add_flag("--quiet", is_quiet_, "no line a request on standard error");
    add_limits(*command);
    return command;
}

void ServeCommand::add_limits(CLI::App& command) {
    RenderLimits& render = settings_.render;
    const auto add = [&](const char* name, auto& number, const char* meaning, auto low, auto high) {
        command.add_option(name, number, meaning)
            ->type_name("N")
            ->capture_default_str()
            ->check(CLI::Range(low, high).description(""))
            ->check(a_number())
            ->group(limits_group);
    };
    constexpr std::size_t many = std::size_t{1} << 40;
    constexpr std::size_t largest_document = 64 << 20;
    add("--time-limit", render.seconds, "seconds of solving", 0.001, 86400.0);
    add("--max-body", settings_.http.body_bytes, "bytes of a scene", std::size_t{1},
        largest_document);
    add("--max-patches", render.patches, "patches", std::size_t{1}, many);
    add("--max-pixels", render.pixels, "pixels in all pictures", std::uint64_t{1},
        std::uint64_t{many});
    add("--max-sensors", render.sensors, "sensors", std::size_t{0}, many);
    add("--max-rays", render.rays, "rays per patch", std::size_t{1}, many);
    add("--memory-limit", render.memory,
        "bytes; 0 for 80 % of what there is, shared by the workers", std::uint64_t{0},
        std::uint64_t{many});
    add("--workers", render.at_once, "solves side by side, in all", 1, 64);
    add("--queue", render.waiting, "solves that wait, in all", 0, 1000);
    add("--max-connections", settings_.http.connections, "connections, in all", std::size_t{1},
        std::size_t{10'000});
}

int ServeCommand::run() {
    const StopSignals signals;
    if (settings_.render.memory == 0)
        settings_.render.memory =
            machine_memory() / 5 * 4 / static_cast<std::uint64_t>(settings_.render.at_once);
    settings_.token = configured_token(token_file_);
    raster::preload_image_codec();
    const Listener listener = listen_on(settings_.host, port_);
    settle_token(listener.is_loopback);
    raster::image_encoder();  // a server that cannot draw should not say that it is ready
    RequestLog log(is_quiet_);
    Service service(settings_, log);
    const RunningService running(service, listener.socket);
    std::cerr << "patchlight: listening on " << url_of(settings_.host, listener.port) << std::endl;
    constexpr milliseconds long_time{3'600'000};
    while (!signals.wait(long_time)) continue;
    log.event("draining");
    signals.let_through();
    wind_down(service, milliseconds(static_cast<long>(grace_ * 1000)));
    return 0;
}

/// Where others can connect, a token is needed: if none is configured, one is made and told.
void ServeCommand::settle_token(bool is_loopback) {
    if (settings_.token || is_loopback) return;
    settings_.token = random_token();
    std::cerr << "patchlight: no token is configured, so here is one for this run; clients send\n"
              << "  Authorization: Bearer " << *settings_.token << std::endl;
}

}  // namespace patchlight::server
