#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace patchlight::server {

/// A glTF document under construction: what is added lands in one buffer.
class GltfDocument {
  public:
    GltfDocument();

    /// Adds an accessor over `bytes` and returns its number.
    std::size_t accessor(std::string_view bytes, int component_type, std::size_t count,
                         const std::string& type);

    /// A node with a mesh of one primitive, which is put into the scene; returns its number.
    std::size_t node(const nlohmann::json& primitive, const nlohmann::json& more = {});

    /// The unit square as four points, number 0 to 3, counter-clockwise seen from +z.
    std::size_t square();

    nlohmann::json json;  // all but the buffer

    std::string text() const;  // with the buffer as a data URI
    std::string glb() const;

  private:
    std::string buffer_;
};

std::string base64_of(std::string_view bytes);

}  // namespace patchlight::server
