#include "server/http/http_message.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace patchlight::server {
namespace {

char small_letter(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// As RFC 9110 5.6.7 wants it, whatever the language of the machine.
std::string date_text(std::time_t time) {
    constexpr std::array days{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr std::array months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::tm utc{};
    if (!gmtime_r(&time, &utc)) return "";
    std::array<char, 32> rest{};
    const std::size_t length = std::strftime(rest.data(), rest.size(), "%Y %H:%M:%S GMT", &utc);
    const std::string day = (utc.tm_mday < 10 ? "0" : "") + std::to_string(utc.tm_mday);
    return std::string(days[static_cast<std::size_t>(utc.tm_wday)]) + ", " + day + " " +
           months[static_cast<std::size_t>(utc.tm_mon)] + " " + std::string(rest.data(), length);
}

}  // namespace

bool same_field(std::string_view one, std::string_view other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](char a, char b) { return small_letter(a) == small_letter(b); });
}

std::optional<std::string_view> HttpRequest::field(std::string_view name) const {
    for (const auto& [own, value] : fields)
        if (same_field(own, name)) return value;
    return std::nullopt;
}

void add_common_fields(const std::string& request_id, HttpAnswer& answer) {
    answer.fields.emplace_back("Date", date_text(std::time(nullptr)));
    answer.fields.emplace_back("X-Request-Id", request_id);
    answer.fields.emplace_back("X-Content-Type-Options", "nosniff");
    answer.fields.emplace_back("Cache-Control", "no-store");
}

std::string closing_answer_text(const HttpAnswer& answer, bool without_body) {
    std::string text = "HTTP/1.1 " + std::to_string(answer.status) + " ";
    text.append(reason_phrase(answer.status)).append("\r\n");
    if (!answer.content_type.empty()) text += "Content-Type: " + answer.content_type + "\r\n";
    for (const auto& [name, value] : answer.fields) text += name + ": " + value + "\r\n";
    text +=
        "Content-Length: " + std::to_string(answer.body.size()) + "\r\nConnection: close\r\n\r\n";
    return without_body ? text : text + answer.body;
}

std::string_view reason_phrase(int status) {
    constexpr std::array<std::pair<int, std::string_view>, 21> phrases{{
        {200, "OK"},
        {204, "No Content"},
        {400, "Bad Request"},
        {401, "Unauthorized"},
        {403, "Forbidden"},
        {404, "Not Found"},
        {405, "Method Not Allowed"},
        {406, "Not Acceptable"},
        {408, "Request Timeout"},
        {413, "Content Too Large"},
        {414, "URI Too Long"},
        {415, "Unsupported Media Type"},
        {417, "Expectation Failed"},
        {422, "Unprocessable Content"},
        {429, "Too Many Requests"},
        {431, "Request Header Fields Too Large"},
        {499, "Client Closed Request"},
        {500, "Internal Server Error"},
        {503, "Service Unavailable"},
        {504, "Gateway Timeout"},
        {507, "Insufficient Storage"},
    }};
    for (const auto& [code, phrase] : phrases)
        if (code == status) return phrase;
    return "Unknown";
}

}  // namespace patchlight::server
