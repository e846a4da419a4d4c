#include "solver/accuracy/shown_places.h"

#include "solver/accuracy/displayed_field.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace patchlight::shown_places_test {
namespace {

struct Shown {
    CutScene cut;
    RayScene rays;
    PatchLocator locator;
    RefinementTree tree;
    TreeDisplay display;

    explicit Shown(const Scene& scene, unsigned seed)
        : cut(patchlight::cut(scene, 0.4)),
          rays(cut.scene, cut.lines.overlaps),
          locator(cut.scene, cut.mesh, rays),
          tree(cut.mesh, find_flat_corners(cut.mesh, find_plane_groups(cut.scene))) {
        std::mt19937 random(seed);
        grow(random, 300);
        tree.balance();
        std::vector<Rgb> light;
        for (std::size_t v = 0; v < tree.vertices().size(); ++v)
            light.push_back(Rgb::Constant(uniform(random)));
        display = make_tree_display(cut.scene, cut.mesh, tree,
                                    {light, std::vector<Rgb>(light.size(), Rgb::Zero())});
    }
    void grow(std::mt19937& random, int splits) {
        for (int k = 0; k < splits; ++k)
            tree.split(static_cast<std::uint32_t>(random() % tree.elements().size()));
    }
    ShownPlaces places() const { return {cut.scene, cut.mesh, rays, locator, tree, display}; }
};

Rgb at(const TreeDisplay& shown, const ShownPlaces::Place& place) {
    Rgb sum = Rgb::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        sum +=
            place.weight[k] * shown.display.radiosity[shown.display.triangles[place.triangle][k]];
    return sum;
}

/// A tree of boxes round the triangles is the second witness.
void expect_what_is_displayed(const Shown& shown) {
    const ShownPlaces places = shown.places();
    const DisplayedField field(shown.cut.scene, shown.cut.mesh, shown.display.display);
    std::mt19937 random(3);
    for (PatchIndex i = 0; i < shown.cut.mesh.size(); ++i)
        for (int k = 0; k < 40; ++k) {
            const SurfaceIndex s = shown.cut.mesh.patches[i].surface;
            const Vec3 point = random_point(shown.cut.mesh, i, random);
            const RayPoint landed = shown.rays.to_ray_space(point, shown.rays.frame(s));
            const auto place = places.find(s, landed);
            ASSERT_TRUE(place);
            const Vec3 read = shown.rays.from_ray_space(landed.cast<double>(), shown.rays.frame(s));
            EXPECT_NEAR(at(shown.display, *place)[0], field.radiosity(s, read)[0], 1e-4);
        }
}

TEST(ShownPlaces, AreThoseOfTheDisplay) {
    for (const unsigned seed : {1u, 2u}) {
        expect_what_is_displayed(Shown(room_with_box(), seed));
        expect_what_is_displayed(Shown(scene_of(star(7, 0.4)), seed));
        expect_what_is_displayed(Shown(scene_of(l_shape()), seed));
    }
}

TEST(ShownPlaces, StayWhereTheTreeGrewSince) {
    Shown shown(room_with_box(), 4);
    std::mt19937 random(5);
    shown.grow(random, 500);
    expect_what_is_displayed(shown);
}

}  // namespace
}  // namespace patchlight::shown_places_test
