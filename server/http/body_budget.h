#pragma once

#include <atomic>
#include <cstddef>

namespace patchlight::server {

/// How many bytes of bodies all connections together may hold.
class BodyBudget {
  public:
    explicit BodyBudget(std::size_t most) : most_(most) {}

    /// What one body holds of it, given back at the end.
    class Share {
      public:
        explicit Share(BodyBudget& budget) : budget_(budget) {}
        ~Share() { budget_.taken_ -= own_; }
        Share(const Share&) = delete;
        Share& operator=(const Share&) = delete;

        /// False if there is no more.
        bool take(std::size_t bytes) {
            own_ += bytes;
            return (budget_.taken_ += bytes) <= budget_.most_;
        }

      private:
        BodyBudget& budget_;
        std::size_t own_ = 0;
    };

  private:
    std::atomic<std::size_t> taken_ = 0;
    std::size_t most_;
};

}  // namespace patchlight::server
