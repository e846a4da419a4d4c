#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace patchlight::server {

/// A binary glTF file taken apart. Whatever breaks the specification (Khronos, "glTF 2.0
/// Specification", 2021) where our files could is a failure of the test.
class GlbReader {
  public:
    explicit GlbReader(const std::string& bytes);

    nlohmann::json document;
    std::string binary;

    /// Number `k` of the accessors, as numbers, one row an element; normalised ones in [0, 1].
    std::vector<std::vector<double>> elements(std::size_t k) const;

    /// The one primitive of a mesh.
    const nlohmann::json& primitive(std::size_t mesh) const;
    std::vector<std::vector<double>> attribute(std::size_t mesh, const std::string& name) const;
    std::vector<std::uint32_t> indices(std::size_t mesh) const;

    /// Views lie in the buffer, accessors in their views, and all are aligned; least and most are
    /// true; indices point to vertices; all that is referred to is there.
    void check() const;

  private:
    void check_accessor(std::size_t k) const;
    void check_mesh(std::size_t k) const;
};

}  // namespace patchlight::server
