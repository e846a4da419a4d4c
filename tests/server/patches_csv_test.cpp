#include "server/patches_csv.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

namespace patchlight::server::patches_csv_test {
namespace {

TEST(PatchesCsv, EveryPatchIsARowByItsIndex) {
    Scene scene = small_job().scene;
    scene.surfaces[1].side = Side::back;
    scene.objects[1].name = "rooms/\"A\", floor";
    std::string written;
    write_patches_csv(scene, small_solution(), [&](std::string_view s) { written += s; });
    EXPECT_EQ(written,
              "index,object,material,side,x,y,z,nx,ny,nz,area,"
              "exitance_r,exitance_g,exitance_b,radiosity_r,radiosity_g,radiosity_b,"
              "irradiance_r,irradiance_g,irradiance_b\n"
              "0,lamp,lamp,front,1,0.5,3,0,0,-1,2,100,100,100,103,102,101,6,4,2\n"
              "1,\"rooms/\"\"A\"\", floor\",grey,back,0.5,0.5,0,0,0,1,1,"
              "0,0,0,9,8,7,22.5,20,17.5\n");
}

}  // namespace
}  // namespace patchlight::server::patches_csv_test
