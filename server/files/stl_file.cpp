#include "server/files/stl_file.h"

#include "server/files/file_bytes.h"
#include "server/files/text_lines.h"
#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace patchlight::server {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_bytes = 84;    // 80 of any text, then the number of triangles
constexpr std::size_t triangle_bytes = 50;  // a normal and three corners of floats, and 2 more

void add_triangle(ImportedGeometry& geometry, std::uint32_t line) {
    const auto first = static_cast<std::uint32_t>(geometry.corners.size());
    for (std::uint32_t k = 0; k < 3; ++k) geometry.corners.push_back(first + k);
    std::vector<FileFace>& faces = geometry.parts.front().faces;
    if (faces.size() >= most_file_faces)
        throw InputError(geometry.file, "has more than " + std::to_string(most_file_faces) +
                                            " triangles, the limit");
    faces.push_back({first, 3, 0, line});
}

std::uint32_t count_of(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

bool is_binary(std::string_view bytes) {
    return bytes.size() >= header_bytes &&
           bytes.size() - header_bytes == std::size_t{count_of(bytes)} * triangle_bytes;
}

bool begins_as_text(std::string_view bytes) {
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    return bytes.starts_with("solid");
}

void read_binary(std::string_view bytes, ImportedGeometry& geometry) {
    for (std::uint32_t number = 0; number < count_of(bytes); ++number) {
        float coordinates[9];
        constexpr std::size_t normal_bytes = 12;
        std::memcpy(coordinates,
                    bytes.data() + header_bytes + number * triangle_bytes + normal_bytes,
                    sizeof coordinates);
        for (const float coordinate : coordinates)
            if (!(std::abs(coordinate) <= largest_file_coordinate))
                throw InputError(geometry.file, "triangle " + std::to_string(number) +
                                                    ": a coordinate is " + number_text(coordinate) +
                                                    "; it must be within ±1e+15");
        for (int k = 0; k < 9; k += 3)
            geometry.vertices.emplace_back(coordinates[k], coordinates[k + 1], coordinates[k + 2]);
        add_triangle(geometry, 0);
    }
}

void expect(TextLines& lines, std::string_view words) {
    for (std::string_view left = words; !left.empty();) {
        const std::string_view word = left.substr(0, left.find(' '));
        left.remove_prefix(std::min(word.size() + 1, left.size()));
        if (const std::string_view found = lines.word(); found != word)
            lines.reject("expected " + in_quotes(words) + ", not " +
                         (found.empty() ? "the end of the line" : in_quotes(found)));
    }
}

void go_on(TextLines& lines, std::string_view expected) {
    if (!lines.next())
        lines.reject("the file ends where " + in_quotes(expected) + " should follow");
    expect(lines, expected);
}

/// After the word `facet`.
void read_facet(TextLines& lines, ImportedGeometry& geometry) {
    const std::uint32_t line = lines.line();
    go_on(lines, "outer loop");
    for (int corner = 0; corner < 3; ++corner) {
        go_on(lines, "vertex");
        geometry.vertices.push_back(lines.point(largest_file_coordinate));
    }
    go_on(lines, "endloop");
    go_on(lines, "endfacet");
    add_triangle(geometry, line);
}

void read_text(std::string_view text, ImportedGeometry& geometry) {
    TextLines lines(text, geometry.file);
    while (lines.next()) {
        expect(lines, "solid");
        while (true) {
            if (!lines.next()) lines.reject("the file ends before 'endsolid'");
            const std::string_view word = lines.word();
            if (word == "endsolid") break;
            if (word != "facet")
                lines.reject("expected 'facet' or 'endsolid', not " + in_quotes(word));
            read_facet(lines, geometry);
        }
    }
}

}  // namespace

ImportedGeometry read_stl(const std::filesystem::path& path, const std::string& file) {
    const std::string bytes = read_file_bytes(path, file);
    ImportedGeometry geometry;
    geometry.file = file;
    geometry.materials.emplace_back();
    geometry.parts.emplace_back();
    if (is_binary(bytes))
        read_binary(bytes, geometry);
    else if (begins_as_text(bytes))
        read_text(bytes, geometry);
    else
        throw InputError(file, "is no STL: text begins with 'solid'; a binary file of " +
                                   std::to_string(count_of(bytes)) +
                                   " triangles, as it says, has " +
                                   std::to_string(header_bytes + triangle_bytes * count_of(bytes)) +
                                   " bytes, not " + std::to_string(bytes.size()));
    if (geometry.corners.empty()) throw InputError(file, "has no triangles");
    return geometry;
}

}  // namespace patchlight::server
