#include "server/http/request_head.h"

#include <algorithm>
#include <charconv>

namespace patchlight::server {
namespace {

constexpr std::string_view line_end = "\r\n";

/// Left by a throw, so that the many checks need no plumbing; it never leaves this file.
struct Refused {
    Problem problem;
};

[[noreturn]] void refuse(int status, const std::string& kind, const std::string& detail) {
    throw Refused{{status, kind, "The request is broken", detail, {}}};
}

[[noreturn]] void refuse(const std::string& detail) { refuse(400, "bad-request", detail); }

std::string_view without_blanks(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    text.remove_prefix(begin);
    while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
    return text;
}

/// The next line without its end.
std::string_view take_line(std::string_view& bytes) {
    const std::size_t end = bytes.find(line_end);
    if (end == std::string_view::npos) refuse("a line must end in CR LF");
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end + line_end.size());
    if (line.find_first_of("\r\n") != std::string_view::npos)
        refuse("CR and LF must stand together");
    return line;
}

bool is_visible(char byte) { return byte > 0x20 && byte < 0x7F; }

void read_request_line(std::string_view line, RequestHead& head) {
    const std::size_t first = line.find(' ');
    const std::size_t last = line.rfind(' ');
    if (first == std::string_view::npos || first == last)
        refuse("the request line must be a method, a target and HTTP/1.1");
    head.method = line.substr(0, first);
    head.target = line.substr(first + 1, last - first - 1);
    const std::string_view version = line.substr(last + 1);
    if (!is_token(head.method) || head.method.size() > 32)
        refuse("the method is no word, such as POST");
    if (head.target.empty() || !std::all_of(head.target.begin(), head.target.end(), is_visible) ||
        head.target.find('#') != std::string::npos)
        refuse("the target must be a path, percent-encoded where it is not plain ASCII");
    if (!head.target.starts_with('/') && head.target != "*")
        refuse("the target must begin with a slash");
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
        refuse("this server speaks HTTP/1.1 and HTTP/1.0");
    head.is_http_1_0 = version == "HTTP/1.0";
}

void read_field(std::string_view line, RequestHead& head) {
    if (line.starts_with(' ') || line.starts_with('\t'))
        refuse("a header field must not be folded over two lines");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
        refuse("a header field must be a name, a colon without a blank before it, and a value");
    const std::string_view value = without_blanks(line.substr(colon + 1));
    const auto is_control = [](unsigned char byte) {
        return (byte < 0x20 && byte != '\t') || byte == 0x7F;
    };
    if (std::any_of(value.begin(), value.end(), is_control))
        refuse("a header field has a control character");
    head.fields.emplace_back(line.substr(0, colon), value);
}

std::vector<std::string_view> values_of(const RequestHead& head, std::string_view name) {
    std::vector<std::string_view> values;
    for (const auto& [own, value] : head.fields)
        if (same_field(own, name)) values.emplace_back(value);
    return values;
}

std::size_t length_of(std::string_view digits) {
    constexpr std::size_t beyond_any_limit = 13;  // digits
    const bool are_digits =
        !digits.empty() &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!are_digits) refuse("Content-Length must be a number of bytes");
    if (digits.size() >= beyond_any_limit)
        refuse(413, "body-too-large", "no body may have a Content-Length of that many digits");
    std::size_t length = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), length);
    return length;
}

void read_framing(RequestHead& head) {
    const auto lengths = values_of(head, "Content-Length");
    const auto codings = values_of(head, "Transfer-Encoding");
    if (lengths.size() > 1) refuse("Content-Length is given more than once");
    if (!lengths.empty() && !codings.empty())
        refuse("Content-Length and Transfer-Encoding must not be given together");
    if (!lengths.empty()) {
        head.has_length = true;
        head.content_length = length_of(lengths.front());
    }
    if (codings.empty()) return;
    if (codings.size() > 1 || !same_field(codings.front(), "chunked"))
        refuse("the only Transfer-Encoding is `chunked`");
    if (head.is_http_1_0) refuse("HTTP/1.0 has no Transfer-Encoding");
    head.is_chunked = true;
}

void read_expectation(RequestHead& head) {
    const auto expectations = values_of(head, "Expect");
    if (expectations.empty() || head.is_http_1_0) return;
    if (expectations.size() > 1 || !same_field(expectations.front(), "100-continue"))
        refuse(417, "expectation-failed", "the only expectation met is `100-continue`");
    head.expects_continue = true;
}

void read_persistence(RequestHead& head) {
    head.keeps_alive = !head.is_http_1_0;  // HTTP/1.0 gets one answer a connection
    for (std::string_view options : values_of(head, "Connection"))
        while (!options.empty()) {
            const std::size_t comma = std::min(options.find(','), options.size());
            if (same_field(without_blanks(options.substr(0, comma)), "close"))
                head.keeps_alive = false;
            options.remove_prefix(std::min(comma + 1, options.size()));
        }
}

RequestHead read(std::string_view bytes) {
    if (bytes.find('\0') != std::string_view::npos) refuse("a NUL byte in the header");
    RequestHead head;
    read_request_line(take_line(bytes), head);
    for (std::string_view line = take_line(bytes); !line.empty(); line = take_line(bytes))
        read_field(line, head);
    const std::size_t hosts = values_of(head, "Host").size();
    if (hosts > 1 || (hosts == 0 && !head.is_http_1_0)) refuse("there must be one field Host");
    read_framing(head);
    read_expectation(head);
    read_persistence(head);
    return head;
}

}  // namespace

bool is_token(std::string_view text) {
    constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
    return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               marks.find(c) != std::string_view::npos;
    });
}

std::variant<RequestHead, Problem> read_request_head(std::string_view bytes) {
    try {
        return read(bytes);
    } catch (Refused& refused) {
        return std::move(refused.problem);
    }
}

}  // namespace patchlight::server
