#include "server/files/gltf_accessors.h"

#include "server/files/gltf_buffers.h"
#include "server/wording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace patchlight::server {
namespace {

constexpr std::int64_t most_elements = 12'000'000;       // of one accessor
constexpr std::size_t most_elements_read = 400'000'000;  // of all, where one is read many times

enum class Component : std::uint16_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

Component read_component(const JsonValue& block) {
    const JsonValue type = block.at("componentType");
    const std::int64_t code = type.whole_number(5120, 5126);
    if (code == 5124) type.reject("must be 5120 to 5123, 5125 or 5126, not 5124");
    return static_cast<Component>(code);
}

std::size_t bytes_of(Component component) {
    switch (component) {
        case Component::int8:
        case Component::uint8:
            return 1;
        case Component::int16:
        case Component::uint16:
            return 2;
        case Component::uint32:
        case Component::float32:
            return 4;
    }
    throw std::logic_error("a component type without a size");
}

/// `normalised`: integers stand for the range from -1 or 0 to 1.
template <typename Number>
double number_at(const char* bytes, bool normalised) {
    Number number{};
    std::memcpy(&number, bytes, sizeof number);
    if (!normalised || !std::numeric_limits<Number>::is_integer) return static_cast<double>(number);
    return std::max(
        static_cast<double>(number) / static_cast<double>(std::numeric_limits<Number>::max()),
        -1.0);
}

double number_at(const char* bytes, Component component, bool normalised) {
    switch (component) {
        case Component::int8:
            return number_at<std::int8_t>(bytes, normalised);
        case Component::uint8:
            return number_at<std::uint8_t>(bytes, normalised);
        case Component::int16:
            return number_at<std::int16_t>(bytes, normalised);
        case Component::uint16:
            return number_at<std::uint16_t>(bytes, normalised);
        case Component::uint32:
            return number_at<std::uint32_t>(bytes, normalised);
        case Component::float32:
            return number_at<float>(bytes, normalised);
    }
    throw std::logic_error("a component type that is not read");
}

std::size_t whole_or(const JsonValue& block, const char* key, std::int64_t otherwise) {
    const auto number = block.find(key);
    constexpr std::int64_t most = std::int64_t{1} << 40;  // no sum of two overflows
    return static_cast<std::size_t>(number ? number->whole_number(0, most) : otherwise);
}

void require_type(const JsonValue& accessor, std::size_t components) {
    const JsonValue type = accessor.at("type");
    const std::string wanted = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
    if (type.text() != wanted)
        type.reject("must be " + in_quotes(wanted) + " here, not " + in_quotes(type.text()));
}

bool is_normalised(const JsonValue& accessor) {
    const auto normalised = accessor.find("normalized");
    return normalised && normalised->boolean();
}

}  // namespace

/// How the elements of an accessor lie in memory.
struct GltfAccessors::Layout {
    Component component = Component::float32;
    std::size_t components = 1;
    std::size_t count = 0;  // of elements
    bool normalised = false;
};

std::string_view GltfAccessors::view_bytes(const JsonValue& reference, std::size_t& stride) const {
    const JsonValue list = root_.at("bufferViews");
    const JsonValue view = list[gltf_index(reference, root_, "bufferViews")];
    const JsonValue buffer_reference = view.at("buffer");
    const std::string& buffer = buffers_[gltf_index(buffer_reference, root_, "buffers")];
    view.at("byteLength");
    const std::size_t offset = whole_or(view, "byteOffset", 0);
    const std::size_t length = whole_or(view, "byteLength", 0);
    if (offset + length > buffer.size())
        view.reject("ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                    std::to_string(buffer.size()));
    if (const auto given = view.find("byteStride"))
        stride = static_cast<std::size_t>(given->whole_number(1, 252));
    return std::string_view(buffer).substr(offset, length);
}

std::size_t GltfAccessors::components_of(const JsonValue& reference) const {
    const JsonValue list = root_.at("accessors");
    const JsonValue accessor = list[gltf_index(reference, root_, "accessors")];
    const JsonValue type = accessor.at("type");
    if (type.text() == "SCALAR") return 1;
    for (std::size_t count = 2; count <= 4; ++count)
        if (type.text() == "VEC" + std::to_string(count)) return count;
    return 0;
}

bool GltfAccessors::has_data(const JsonValue& reference) const {
    const JsonValue list = root_.at("accessors");
    const JsonValue accessor = list[gltf_index(reference, root_, "accessors")];
    return accessor.has("bufferView") || accessor.has("sparse");
}

std::string_view GltfAccessors::view(const JsonValue& reference) const {
    std::size_t stride = 0;
    return view_bytes(reference, stride);
}

/// `place` has the `bufferView` and the `byteOffset`: an accessor, or a part of a sparse one.
void GltfAccessors::read_elements(const JsonValue& place, const Layout& layout,
                                  std::vector<double>& numbers) const {
    const std::size_t component_bytes = bytes_of(layout.component);
    const std::size_t element_bytes = component_bytes * layout.components;
    std::size_t stride = element_bytes;
    const JsonValue reference = place.at("bufferView");
    const std::string_view bytes = view_bytes(reference, stride);
    const std::size_t offset = whole_or(place, "byteOffset", 0);
    const std::size_t end = offset + (layout.count - 1) * stride + element_bytes;
    if (end > bytes.size())
        place.reject("its " + std::to_string(layout.count) + " elements end at byte " +
                     std::to_string(end) + " of a buffer view of " + std::to_string(bytes.size()));
    numbers.clear();
    numbers.reserve(layout.count * layout.components);
    for (std::size_t k = 0; k < layout.count; ++k)
        for (std::size_t c = 0; c < layout.components; ++c)
            numbers.push_back(number_at(bytes.data() + offset + k * stride + c * component_bytes,
                                        layout.component, layout.normalised));
}

void GltfAccessors::put_substitutes(const JsonValue& sparse, const Layout& layout,
                                    std::vector<double>& numbers) {
    const JsonValue count = sparse.at("count");
    const JsonValue index_block = sparse.at("indices");
    const JsonValue value_block = sparse.at("values");
    Layout substitutes = layout;
    substitutes.count =
        static_cast<std::size_t>(count.whole_number(1, static_cast<std::int64_t>(layout.count)));
    const Layout index_layout{read_component(index_block), 1, substitutes.count};
    spend(sparse, substitutes.count);
    std::vector<double> places, values;
    read_elements(index_block, index_layout, places);
    read_elements(value_block, substitutes, values);
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (!(places[k] >= 0 && places[k] < static_cast<double>(layout.count)))
            index_block.reject("element " + number_text(places[k]) +
                               " does not exist; the accessor has " + std::to_string(layout.count));
        const auto first = static_cast<std::size_t>(places[k]) * layout.components;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(k * layout.components),
                    layout.components, numbers.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

/// A small file may have a large accessor read over and over.
void GltfAccessors::spend(const JsonValue& accessor, std::size_t elements) {
    elements_read_ += elements;
    if (elements_read_ > most_elements_read)
        accessor.reject("more than " + std::to_string(most_elements_read) +
                        " elements would be read from this file");
}

std::vector<double> GltfAccessors::numbers(const JsonValue& reference, std::size_t components) {
    const std::size_t index = gltf_index(reference, root_, "accessors");
    const JsonValue list = root_.at("accessors");
    const JsonValue accessor = list[index];
    require_type(accessor, components);
    const JsonValue count = accessor.at("count");
    const Layout layout{read_component(accessor), components,
                        static_cast<std::size_t>(count.whole_number(1, most_elements)),
                        is_normalised(accessor)};
    spend(accessor, layout.count);
    std::vector<double> numbers;
    if (accessor.has("bufferView"))
        read_elements(accessor, layout, numbers);
    else
        numbers.assign(layout.count * components, 0.0);
    if (const auto sparse = accessor.find("sparse")) put_substitutes(*sparse, layout, numbers);
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
        accessor.reject("has a number that is not finite");
    return numbers;
}

std::vector<std::uint32_t> GltfAccessors::indices(const JsonValue& reference) {
    const std::size_t index = gltf_index(reference, root_, "accessors");
    const JsonValue list = root_.at("accessors");
    const JsonValue accessor = list[index];
    const JsonValue type = accessor.at("componentType");
    if (const auto component = read_component(accessor); component != Component::uint8 &&
                                                         component != Component::uint16 &&
                                                         component != Component::uint32)
        type.reject("indices must be 5121, 5123 or 5125 (unsigned)");
    const std::vector<double> exact = numbers(reference, 1);
    std::vector<std::uint32_t> whole;
    whole.reserve(exact.size());
    for (const double number : exact) whole.push_back(static_cast<std::uint32_t>(number));
    return whole;
}

}  // namespace patchlight::server
