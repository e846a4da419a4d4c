#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace patchlight::server {

/// A glTF document and its one buffer as they grow, to be packed into one file. Names follow
/// Khronos, "glTF 2.0 Specification", 2021, sections 3.6 and 4.4.
class GlbContainer {
  public:
    nlohmann::ordered_json document;

    /// Adds elements of `stride` bytes each as a buffer view, and returns its number. `target`:
    /// what a graphics card takes it for.
    enum class Target : std::uint16_t { vertices = 34962, indices = 34963 };
    std::size_t add_view(std::string_view bytes, std::size_t stride, Target target);

    /// Adds part of a view: `count` elements from byte `offset` on. Returns its number. Each must
    /// begin at a multiple of 4 bytes. `unit_u16` is normalised: 65535 stands for 1.
    enum class Component : std::uint16_t { unit_u16 = 5123, u32 = 5125, f32 = 5126 };
    std::size_t add_accessor(std::size_t view, std::size_t offset, Component component,
                             std::size_t count, const char* type);

    /// The file: header, JSON chunk and binary chunk. Throws std::length_error if it would not fit
    /// into 4 GiB, the most that its header can tell.
    std::string packed();

  private:
    std::string buffer_;
};

}  // namespace patchlight::server
