#pragma once

#include "server/json_value.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// Reads the accessors of a glTF document, whatever their component type, stride or sparse
/// substitutes. Every range is held against the bytes there are before a byte is read; what does
/// not fit throws InputError.
class GltfAccessors {
  public:
    /// Both have to outlive it.
    GltfAccessors(const JsonValue& root, const std::vector<std::string>& buffers)
        : root_(root), buffers_(buffers) {}

    /// The numbers of the accessor that `reference` names, `components` for each element: 3 for
    /// points. Normalised integers come out in [-1, 1].
    std::vector<double> numbers(const JsonValue& reference, std::size_t components);

    /// The numbers of an accessor of vertex indices: integers, one for each element.
    std::vector<std::uint32_t> indices(const JsonValue& reference);

    /// How many numbers an element of an accessor has; 0 for those that are no scalar or vector.
    std::size_t components_of(const JsonValue& reference) const;

    /// Whether an accessor has data of its own: else all its numbers are 0.
    bool has_data(const JsonValue& reference) const;

    /// The bytes of a buffer view.
    std::string_view view(const JsonValue& reference) const;

  private:
    struct Layout;

    std::string_view view_bytes(const JsonValue& reference, std::size_t& stride) const;
    void read_elements(const JsonValue& place, const Layout& layout,
                       std::vector<double>& numbers) const;
    void put_substitutes(const JsonValue& sparse, const Layout& layout,
                         std::vector<double>& numbers);
    void spend(const JsonValue& accessor, std::size_t elements);

    const JsonValue& root_;
    const std::vector<std::string>& buffers_;
    std::size_t elements_read_ = 0;
};

}  // namespace patchlight::server
