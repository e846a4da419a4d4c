// Light that goes to and fro between surfaces close to each other: what is wrong there lights
// itself, and comes to much more than what one look at it misses.
#include "solver/accuracy/field_difference.h"
#include "tests/physics/rooms.h"

#include <array>

namespace patchlight::near_test {
namespace {

/// A lamp below a ceiling: how far, how large, and what all surfaces reflect.
struct Near {
    const char* name;
    double gap, wide, deep, reflectance;
    bool faces_up;  // alone; else it gives light all round
};

void PrintTo(const Near& near, std::ostream* out) { *out << near.name; }

Scene room_of(const Near& near) {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(near.reflectance, 0.0),
                        lamp = builder.material(0.8, 100.0);
    const Vec3 room(4.7, 5.8, 3.0);
    builder.box("room", wall, Vec3::Zero(), room, true);
    const Vec3 low(0.9, 3.9, room.z() - near.gap - 0.07),
        high(0.9 + near.wide, 3.9 + near.deep, room.z() - near.gap);
    constexpr int top = 1;
    builder.box("lamp", near.faces_up ? wall : lamp, low, high, false,
                Eigen::Isometry3d::Identity(), near.faces_up ? top : -1);
    if (near.faces_up)
        builder.polygon("panel", lamp,
                        {{low.x(), low.y(), high.z()},
                         {high.x(), low.y(), high.z()},
                         {high.x(), high.y(), high.z()},
                         {low.x(), high.y(), high.z()}});
    builder.box("box", wall, Vec3(2.8, 2.7, 0.05), Vec3(3.5, 3.5, 0.9), false);
    return builder.scene;
}

class Gaps : public testing::TestWithParam<Near> {};

TEST_P(Gaps, AreAsWrongAsTheySay) {
    const Scene scene = room_of(GetParam());
    SolveSettings settings;
    settings.accuracy = 0.01;
    settings.seed = 5;
    const Solution fine = solve(scene, settings);
    const std::vector<ComparedPoint> points = spread_points(fine, 40000);
    const auto field = [&](const Solution& solution) {
        return reflected_at(scene, DisplayedField(scene, solution), points);
    };
    const std::vector<double> right = field(fine);
    settings.seed = 1;
    for (const double accuracy : {0.1, 0.03}) {
        settings.accuracy = accuracy;
        const Solution rough = solve(scene, settings);
        const std::optional<double> wrong = relative_difference(field(rough), right);
        ASSERT_TRUE(wrong && rough.error.estimate);
        EXPECT_LE(*wrong, *rough.error.estimate + *fine.error.estimate) << accuracy;
        EXPECT_TRUE(rough.error.met());
    }
}

constexpr std::array rooms{
    Near{"Slit", 0.025, 1.4, 0.29, 0.8, true}, Near{"Panel", 0.1, 1.2, 0.6, 0.9, true},
    Near{"Box", 0.05, 0.8, 0.5, 0.95, false}, Near{"Spot", 0.03, 0.25, 0.15, 0.9, false}};

INSTANTIATE_TEST_SUITE_P(OfEveryKind, Gaps, testing::ValuesIn(rooms),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace patchlight::near_test
