#include "server/wrong_input.h"

#include "server/input_errors.h"
#include "server/json_document.h"

namespace patchlight::server {

void naming_file(const std::string& file, const std::function<void()>& work) {
    try {
        work();
    } catch (const JsonError& error) {
        std::string place = file;
        if (error.line() > 0)
            place += ":" + std::to_string(error.line()) + ":" + std::to_string(error.column());
        if (!error.pointer().empty()) place += ": " + error.pointer();
        throw WrongInput(place + ": " + error.what());
    } catch (const InputError& error) {
        std::string lines;
        for (const InputFault& fault : faults_of(error)) {
            const std::string place = fault.pointer.empty() ? "" : ": " + fault.pointer;
            lines += (lines.empty() ? "" : "\n") + file + place + ": " + fault.detail;
        }
        throw WrongInput(lines);
    }
}

}  // namespace patchlight::server
