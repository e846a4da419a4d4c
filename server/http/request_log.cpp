#include "server/http/request_log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

/// UTC with milliseconds, RFC 3339.
std::string timestamp() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto since =
        std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%FT%T", &utc);
    const std::string fraction = std::to_string(1000 + since.count() % 1000).substr(1);
    return std::string(text.data()) + "." + fraction + "Z";
}

/// ASCII alone, so that no terminal takes any of it for a command.
std::string line(const Json& entry) {
    return entry.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace

RequestLog::RequestLog(bool is_quiet)
    : logger_(std::make_shared<spdlog::logger>("patchlight",
                                               std::make_shared<spdlog::sinks::stderr_sink_mt>())) {
    logger_->set_pattern("%v");
    logger_->set_level(is_quiet ? spdlog::level::warn : spdlog::level::info);
    logger_->flush_on(spdlog::level::info);
}

void RequestLog::request(const HttpRequest& request, const HttpAnswer& answer,
                         const Delivery& delivery) {
    Json entry{{"time", timestamp()},
               {"event", "request"},
               {"id", request.id},
               {"method", request.method.empty() ? "-" : request.method},
               {"route", answer.route},
               {"status", answer.status},
               {"ms", std::round(delivery.seconds * 1e4) / 10},
               {"bytes", delivery.bytes},
               {"remote", request.remote}};
    if (!delivery.is_whole) entry["cut"] = true;
    logger_->info("{}", line(entry));
}

void RequestLog::failure(const HttpRequest& request, const std::string& what) {
    logger_->error(
        "{}",
        line({{"time", timestamp()}, {"event", "failure"}, {"id", request.id}, {"what", what}}));
}

void RequestLog::event(const std::string& what) {
    logger_->info("{}", line({{"time", timestamp()}, {"event", what}}));
}

}  // namespace patchlight::server
