#include "tests/server/glb_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace patchlight::server {
namespace {

using Json = nlohmann::json;

template <class Number>
Number read(const std::string& bytes, std::size_t offset) {
    Number number{};
    if (offset + sizeof number > bytes.size())
        ADD_FAILURE() << "byte " << offset << " of " << bytes.size();
    else
        std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

std::size_t component_size(int component) {
    return component == 5123 ? 2 : component == 5125 || component == 5126 ? 4 : 0;
}

std::size_t component_count(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

double component_at(const std::string& bytes, std::size_t offset, int component) {
    if (component == 5123) return read<std::uint16_t>(bytes, offset) / 65535.0;
    if (component == 5125) return read<std::uint32_t>(bytes, offset);
    return static_cast<double>(read<float>(bytes, offset));
}

std::size_t number_in(const Json& object, const char* key) { return object.value(key, 0u); }

}  // namespace

GlbReader::GlbReader(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(read<std::uint32_t>(bytes, 4), 2u);
    EXPECT_EQ(read<std::uint32_t>(bytes, 8), bytes.size());
    const std::size_t text_size = read<std::uint32_t>(bytes, 12);
    EXPECT_EQ(text_size % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    document = Json::parse(bytes.substr(20, text_size));
    const std::size_t second = 20 + text_size;
    if (second == bytes.size()) return;
    const std::size_t binary_size = read<std::uint32_t>(bytes, second);
    EXPECT_EQ(binary_size % 4, 0u);
    EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(second + 8 + binary_size, bytes.size());
    binary = bytes.substr(second + 8);
}

std::vector<std::vector<double>> GlbReader::elements(std::size_t k) const {
    const Json& accessor = document["accessors"].at(k);
    const Json& view = document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const int component = accessor["componentType"];
    const std::size_t size = component_size(component);
    const std::size_t count = component_count(accessor["type"]);
    const std::size_t stride = view.value("byteStride", size * count);
    const std::size_t begin = number_in(view, "byteOffset") + number_in(accessor, "byteOffset");
    std::vector<std::vector<double>> rows;
    for (std::size_t row = 0; row < accessor["count"].get<std::size_t>(); ++row) {
        rows.emplace_back();
        for (std::size_t c = 0; c < count; ++c)
            rows.back().push_back(component_at(binary, begin + row * stride + c * size, component));
    }
    return rows;
}

const Json& GlbReader::primitive(std::size_t mesh) const {
    return document["meshes"].at(mesh)["primitives"].at(0);
}

std::vector<std::vector<double>> GlbReader::attribute(std::size_t mesh,
                                                      const std::string& name) const {
    return elements(primitive(mesh)["attributes"].at(name).get<std::size_t>());
}

std::vector<std::uint32_t> GlbReader::indices(std::size_t mesh) const {
    std::vector<std::uint32_t> numbers;
    for (const auto& element : elements(primitive(mesh)["indices"].get<std::size_t>()))
        numbers.push_back(static_cast<std::uint32_t>(element.at(0)));
    return numbers;
}

void GlbReader::check() const {
    EXPECT_EQ(document["asset"]["version"], "2.0");
    ASSERT_TRUE(document["buffers"].size() == 1);
    const std::size_t buffer = document["buffers"][0]["byteLength"];
    EXPECT_LE(buffer, binary.size());
    EXPECT_LT(binary.size() - buffer, 4u);
    for (const Json& view : document["bufferViews"]) {
        EXPECT_EQ(number_in(view, "byteOffset") % 4, 0u);
        EXPECT_LE(number_in(view, "byteOffset") + view["byteLength"].get<std::size_t>(), buffer);
        EXPECT_GE(view["byteLength"].get<std::size_t>(), 1u);
    }
    for (std::size_t k = 0; k < document["accessors"].size(); ++k) check_accessor(k);
    for (std::size_t k = 0; k < document["meshes"].size(); ++k) check_mesh(k);
    for (const Json& node : document["nodes"])
        EXPECT_LT(node["mesh"].get<std::size_t>(), document["meshes"].size());
    const std::size_t scene = document["scene"];
    for (const Json& root : document["scenes"].at(scene)["nodes"])
        EXPECT_LT(root.get<std::size_t>(), document["nodes"].size());
}

void GlbReader::check_accessor(std::size_t k) const {
    const Json& accessor = document["accessors"][k];
    const Json& view = document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::size_t element =
        component_size(accessor["componentType"]) * component_count(accessor["type"]);
    EXPECT_GT(element, 0u) << accessor;
    const std::size_t stride = view.value("byteStride", element);
    const std::size_t offset = number_in(accessor, "byteOffset");
    const std::size_t count = accessor["count"];
    EXPECT_GE(count, 1u);
    EXPECT_GE(stride, element);
    EXPECT_EQ(stride % 4, 0u);
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + (count - 1) * stride + element, view["byteLength"].get<std::size_t>());
    if (!accessor.contains("min")) return;
    std::vector<double> least = elements(k).at(0), most = least;
    for (const auto& row : elements(k))
        for (std::size_t c = 0; c < row.size(); ++c) {
            least[c] = std::min(least[c], row[c]);
            most[c] = std::max(most[c], row[c]);
        }
    EXPECT_EQ(accessor["min"].get<std::vector<double>>(), least);
    EXPECT_EQ(accessor["max"].get<std::vector<double>>(), most);
}

void GlbReader::check_mesh(std::size_t k) const {
    EXPECT_EQ(document["meshes"][k]["primitives"].size(), 1u);
    const Json& attributes = primitive(k)["attributes"];
    const Json& position = document["accessors"].at(attributes["POSITION"].get<std::size_t>());
    EXPECT_TRUE(position.contains("min") && position.contains("max"));
    EXPECT_LT(primitive(k)["material"].get<std::size_t>(), document["materials"].size());
    for (const auto& [name, number] : attributes.items())
        EXPECT_EQ(document["accessors"].at(number.get<std::size_t>())["count"], position["count"])
            << name;
    const std::vector<std::uint32_t> corners = indices(k);
    EXPECT_EQ(corners.size() % 3, 0u);
    EXPECT_LT(*std::max_element(corners.begin(), corners.end()),
              position["count"].get<std::uint32_t>());
}

}  // namespace patchlight::server
