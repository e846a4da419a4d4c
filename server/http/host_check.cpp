#include "server/http/host_check.h"

#include "server/http/http_message.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>

namespace patchlight::server {
namespace {

/// Of "name:port" or "[::1]:port"; empty if the port is no number.
std::string_view name_in(std::string_view host) {
    std::size_t colon = host.rfind(':');
    if (host.ends_with(']')) colon = std::string_view::npos;
    if (colon == std::string_view::npos) return host;
    const std::string_view port = host.substr(colon + 1);
    const bool is_number = port.size() <= 5 && std::all_of(port.begin(), port.end(), [](char c) {
                               return c >= '0' && c <= '9';
                           });
    return is_number ? host.substr(0, colon) : std::string_view();
}

bool is_address(std::string name) {
    in_addr four{};
    if (::inet_pton(AF_INET, name.c_str(), &four) == 1) return true;
    if (!name.starts_with('[') || !name.ends_with(']')) return false;
    in6_addr six{};
    return ::inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), &six) == 1;
}

}  // namespace

HostCheck::HostCheck(const std::string& bound, const std::vector<std::string>& allowed)
    : names_(allowed) {
    names_.push_back(bound);
    names_.emplace_back("localhost");
}

bool HostCheck::passes(std::string_view host) const {
    const std::string_view name = name_in(host);
    if (name.empty()) return false;
    return is_address(std::string(name)) ||
           std::any_of(names_.begin(), names_.end(),
                       [&](const std::string& known) { return same_field(known, name); });
}

bool is_same_origin(std::string_view origin, std::optional<std::string_view> host) {
    for (const std::string_view scheme : {"http://", "https://"})
        if (origin.starts_with(scheme) && host)
            return same_field(origin.substr(scheme.size()), *host);
    return false;
}

}  // namespace patchlight::server
