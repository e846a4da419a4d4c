#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace patchlight::server {

/// SHA-256 of whatever is added, in order (FIPS 180-4).
class Sha256 {
  public:
    Sha256();
    void add(std::string_view bytes);
    void add(double number);  // as 8 bytes, little-endian
    std::string hex();        // 64 digits; ends the sum

  private:
    std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

}  // namespace patchlight::server
