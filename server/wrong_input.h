#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace patchlight::server {

/// What a user of the command line has to put right, said in full, with the file it is about: one
/// line for each thing.
class WrongInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Runs `work`, and turns any InputError into WrongInput that names the file: "room.json:3:7: …"
/// or "room.json: /objects/3: …".
void naming_file(const std::string& file, const std::function<void()>& work);

}  // namespace patchlight::server
