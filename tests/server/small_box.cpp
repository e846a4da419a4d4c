#include "tests/server/small_box.h"

#include "tests/server/run_program.h"

namespace patchlight::server {

const std::string small_box = R"({
  "version": 1,
  "materials": {"white": {"reflectance": 0.7}, "lamp": {"reflectance": 0.2, "radiance": 5}},
  "objects": [
    {"name": "walls", "material": "white", "mesh": {
       "vertices": [[0,0,0],[2,0,0],[2,2,0],[0,2,0],[0,0,2],[2,0,2],[2,2,2],[0,2,2]],
       "faces": [[0,1,2,3],[4,7,6,5],[0,3,7,4],[1,5,6,2],[0,4,5,1],[3,2,6,7]]}},
    {"name": "lamp", "material": "lamp",
     "polygon": [[0.7,0.7,1.9],[0.7,1.3,1.9],[1.3,1.3,1.9],[1.3,0.7,1.9]]}],
  "cameras": [{"name": "main", "eye": [1,1,1.5], "look_at": [1,1.2,0], "size": [32,24]}],
  "sensors": [{"name": "desk", "position": [1,1,0.8], "normal": [0,0,1]}],
  "solve": {"patch_size": 0.7, "form_factors": "analytic"}})";

std::string small_box_file() { return write_test_file("box.json", small_box); }

}  // namespace patchlight::server
