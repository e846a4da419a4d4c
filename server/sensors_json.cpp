#include "server/sensors_json.h"

#include "server/input_errors.h"
#include "server/json_vectors.h"
#include "server/unique_names.h"

#include <string>

namespace patchlight::server {
namespace {

constexpr int most_along_a_side = 10'000;
constexpr std::size_t most_sensors = 1'000'000;

struct GridShape {
    Vec3 origin, u, v;  // a corner and the two sides [m]
    int count_u = 1;
    int count_v = 1;

    Vec3 centre(int i, int j) const {
        return origin + (i + 0.5) / count_u * u + (j + 0.5) / count_v * v;
    }
};

int read_count(const JsonValue& value) {
    return static_cast<int>(value.whole_number(1, most_along_a_side));
}

/// A side may only have no length where it is not divided.
Vec3 read_side(const JsonValue& value, const Eigen::Affine3d& to_scene, int count) {
    const Vec3 side = read_point(value, to_scene);
    if (count > 1 && side.norm() == 0) value.reject("must not be zero");
    return side;
}

GridShape read_grid_shape(const JsonValue& block, const Eigen::Affine3d& to_scene) {
    block.require_object({"origin", "u", "v", "count"});
    const JsonValue count = block.at("count");
    const JsonValue origin = block.at("origin");
    const JsonValue u = block.at("u");
    const JsonValue v = block.at("v");
    if (count.size() != 2)
        count.reject("must have 2 numbers, along u and along v, not " +
                     std::to_string(count.size()));
    GridShape shape;
    shape.count_u = read_count(count[0]);
    shape.count_v = read_count(count[1]);
    shape.origin = read_point(origin, to_scene);
    shape.u = read_side(u, to_scene, shape.count_u);
    shape.v = read_side(v, to_scene, shape.count_v);
    return shape;
}

class SensorReader {
  public:
    SensorReader(double metres, Scene& scene) : to_scene_(Eigen::Scaling(metres)), scene_(scene) {}

    void read(const JsonValue& sensor, std::size_t k) {
        sensor.require_object({"name", "position", "normal", "grid"});
        const auto position = sensor.find("position");
        const auto grid = sensor.find("grid");
        if (position.has_value() == grid.has_value())
            sensor.reject("needs one of 'position' and 'grid'");
        const auto name_given = sensor.find("name");
        const std::string name = name_given ? name_given->name() : name_of_unnamed(k);
        const JsonValue normal = sensor.at("normal");
        if (position)
            add({name, read_point(*position, to_scene_), read_direction(normal)}, sensor);
        else
            add_grid(name, read_grid_shape(*grid, to_scene_), read_direction(normal), sensor);
    }

  private:
    void require_room(std::size_t more, const JsonValue& place) const {
        if (scene_.sensors.size() + more > most_sensors)
            place.reject("the scene would have " + std::to_string(scene_.sensors.size() + more) +
                         " sensors; the limit is " + std::to_string(most_sensors));
    }

    void add(const Sensor& sensor, const JsonValue& place) {
        require_room(1, place);
        names_.claim(sensor.name, place);
        scene_.sensors.push_back(sensor);
    }

    void add_grid(const std::string& name, const GridShape& shape, const Vec3& normal,
                  const JsonValue& place) {
        require_room(
            static_cast<std::size_t>(shape.count_u) * static_cast<std::size_t>(shape.count_v),
            place);
        names_.claim(name, place);
        scene_.grids.push_back({name, scene_.sensors.size(), shape.count_u, shape.count_v});
        for (int j = 0; j < shape.count_v; ++j)
            for (int i = 0; i < shape.count_u; ++i)
                add({name + "[" + std::to_string(i) + "," + std::to_string(j) + "]",
                     shape.centre(i, j), normal},
                    place);
    }

    Eigen::Affine3d to_scene_;
    Scene& scene_;
    UniqueNames names_;
};

}  // namespace

void read_sensors(const JsonValue& list, double metres, Scene& scene) {
    SensorReader reader(metres, scene);
    FaultList faults;
    for (std::size_t k = 0; k < list.size(); ++k) faults.attempt([&] { reader.read(list[k], k); });
    faults.throw_if_any();
}

}  // namespace patchlight::server
