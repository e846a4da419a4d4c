#pragma once

#include "solver/scene/input_error.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace patchlight::server {

/// One thing that is wrong with the input: where, and what would be right.
struct InputFault {
    std::string pointer;
    std::string detail;
    bool operator==(const InputFault&) const = default;
};

/// Several things are wrong with the input. As an InputError, it speaks of the first.
class InputErrors : public InputError {
  public:
    /// `faults` must not be empty.
    explicit InputErrors(std::vector<InputFault> faults)
        : InputError(faults.front().pointer, faults.front().detail), faults_(std::move(faults)) {}
    const std::vector<InputFault>& faults() const { return faults_; }

  private:
    std::vector<InputFault> faults_;
};

/// All that an error has to say: one fault, or those of InputErrors.
std::vector<InputFault> faults_of(const InputError& error);

/// Collects what is wrong with parts of the input that can be judged one without the other.
class FaultList {
  public:
    static constexpr std::size_t most = 20;

    /// Does `work`, unless the list is full, and keeps the InputError it may throw. Returns whether
    /// it was done without any.
    template <typename Work>
    bool attempt(const Work& work) {
        if (faults_.size() >= most) return false;
        try {
            work();
            return true;
        } catch (const InputError& error) {
            add(error);
            return false;
        }
    }

    std::size_t size() const { return faults_.size(); }

    /// Throws InputErrors if there is any fault.
    void throw_if_any() const;

  private:
    void add(const InputError& error);

    std::vector<InputFault> faults_;
};

}  // namespace patchlight::server
