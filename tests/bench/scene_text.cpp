#include "tests/bench/scene_text.h"

#include <cstdio>

namespace patchlight {

namespace {

std::string text_of(double x) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.12g", x);
    return text.data();
}

std::string text_of(const Rgb& x) {
    if (x[0] == x[1] && x[1] == x[2]) return text_of(x[0]);
    return "[" + text_of(x[0]) + "," + text_of(x[1]) + "," + text_of(x[2]) + "]";
}

std::string text_of(const Vec3& p) {
    return "[" + text_of(p.x()) + "," + text_of(p.y()) + "," + text_of(p.z()) + "]";
}

std::string places(const std::vector<Vec3>& points, const Eigen::Affine3d& transform) {
    std::string text;
    for (const Vec3& p : points) text += (text.empty() ? "[" : ",") + text_of(Vec3(transform * p));
    return text + "]";
}

}  // namespace

std::string SceneText::material(const Paint& paint) {
    const std::string name = "m" + std::to_string(material_count_++);
    materials_ += (materials_.empty() ? "\n  \"" : ",\n  \"") + name +
                  "\": {\"reflectance\": " + text_of(paint.reflectance);
    if ((paint.radiance > 0.0).any()) materials_ += ", \"radiance\": " + text_of(paint.radiance);
    if (paint.two_sided) materials_ += ", \"two_sided\": true";
    materials_ += "}";
    return name;
}

void SceneText::object(const std::string& name, const std::string& material) {
    objects_ += (objects_.empty() ? "\n  {\"name\": \"" : ",\n  {\"name\": \"") + name + "-" +
                std::to_string(object_count_++) + "\", \"material\": \"" + material + "\", ";
}

void SceneText::polygon(const std::string& name, const std::string& material,
                        const std::vector<Vec3>& corners) {
    object(name, material);
    objects_ += "\"polygon\": " + places(corners, transform) + "}";
}

void SceneText::quad(const std::string& name, const std::string& material, const Vec3& o,
                     const Vec3& a, const Vec3& b) {
    polygon(name, material, {o, o + a, o + a + b, o + b});
}

void SceneText::mesh(const std::string& name, const std::string& material,
                     const std::vector<Vec3>& vertices,
                     const std::vector<std::vector<std::size_t>>& faces) {
    object(name, material);
    objects_ += "\"mesh\": {\"vertices\": " + places(vertices, transform) + ", \"faces\": [";
    for (std::size_t k = 0; k < faces.size(); ++k) {
        objects_ += k > 0 ? ",[" : "[";
        for (std::size_t n = 0; n < faces[k].size(); ++n)
            objects_ += (n > 0 ? "," : "") + std::to_string(faces[k][n]);
        objects_ += "]";
    }
    objects_ += "]}}";
}

std::string SceneText::document() const {
    return "{\"version\": 1,\n \"materials\": {" + materials_ + "},\n \"objects\": [" + objects_ +
           "]}\n";
}

}  // namespace patchlight
