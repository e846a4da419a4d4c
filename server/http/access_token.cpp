#include "server/http/access_token.h"

#include "server/wrong_input.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace patchlight::server {
namespace {

using Digest = std::array<unsigned char, EVP_MAX_MD_SIZE>;

Digest digest_of(std::string_view text) {
    Digest digest{};
    if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("SHA-256 is not available");
    return digest;
}

void require_usable(const std::string& source, const std::string& token) {
    constexpr std::size_t shortest = 16;
    const auto is_visible = [](char c) { return c > 0x20 && c < 0x7F; };
    if (token.size() < shortest)
        throw WrongInput(source + ": the token must have at least " + std::to_string(shortest) +
                         " characters, or it can be guessed");
    if (!std::all_of(token.begin(), token.end(), is_visible))
        throw WrongInput(source + ": the token must be of visible ASCII characters, no blanks");
}

}  // namespace

bool shows_token(const HttpRequest& request, std::string_view token) {
    constexpr std::string_view scheme = "Bearer ";
    const auto field = request.field("Authorization");
    if (!field || field->size() <= scheme.size() ||
        !same_field(field->substr(0, scheme.size()), scheme))
        return false;
    const Digest shown = digest_of(field->substr(scheme.size()));
    const Digest right = digest_of(token);
    return CRYPTO_memcmp(shown.data(), right.data(), right.size()) == 0;
}

std::optional<std::string> configured_token(const std::optional<std::string>& file) {
    if (file) {
        std::ifstream stream(*file);
        std::string token;
        if (!stream) throw WrongInput("--token-file " + *file + ": cannot be read");
        std::getline(stream, token);
        if (token.ends_with('\r')) token.pop_back();
        require_usable("--token-file " + *file, token);
        return token;
    }
    const char* const variable = std::getenv("PATCHLIGHT_TOKEN");
    if (!variable || !*variable) return std::nullopt;
    require_usable("PATCHLIGHT_TOKEN", variable);
    return variable;
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
        throw std::runtime_error("no random numbers for a token");
    constexpr std::string_view digits = "0123456789abcdef";
    std::string token;
    for (const unsigned char byte : bytes) {
        token += digits[byte >> 4];
        token += digits[byte & 15];
    }
    return token;
}

}  // namespace patchlight::server
