#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// Which names a server lets itself be called by. A web page may point a name of its own at this
/// machine and have a browser ask us things (DNS rebinding): such a name is not on the list.
/// Addresses always pass, for no page comes from an address that is not its own.
class HostCheck {
  public:
    /// `bound` is what the server listens on; localhost passes always.
    HostCheck(const std::string& bound, const std::vector<std::string>& allowed);

    /// A field Host: "name" or "name:port".
    bool passes(std::string_view host) const;

  private:
    std::vector<std::string> names_;
};

/// Whether a field Origin names the place the request went to: "http://name:port" for Host
/// "name:port". Pages from elsewhere, and of no known place ("null"), have no business here.
bool is_same_origin(std::string_view origin, std::optional<std::string_view> host);

}  // namespace patchlight::server
