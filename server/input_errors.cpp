#include "server/input_errors.h"

#include <algorithm>

namespace patchlight::server {

std::vector<InputFault> faults_of(const InputError& error) {
    if (const auto* several = dynamic_cast<const InputErrors*>(&error)) return several->faults();
    return {{error.pointer(), error.what()}};
}

void FaultList::add(const InputError& error) {
    // The same mistake may be met again, by way of each instance of one definition.
    for (InputFault& fault : faults_of(error))
        if (faults_.size() < most &&
            std::find(faults_.begin(), faults_.end(), fault) == faults_.end())
            faults_.push_back(std::move(fault));
}

void FaultList::throw_if_any() const {
    if (!faults_.empty()) throw InputErrors(faults_);
}

}  // namespace patchlight::server
