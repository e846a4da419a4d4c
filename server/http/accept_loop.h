#pragma once

#include "server/http/connection.h"
#include "server/http/connection_count.h"

#include <atomic>
#include <functional>
#include <memory>

namespace patchlight::server {

/// Accepts connections and gives each a thread of its own, up to the limits: a queue of
/// connections behind a few threads would let as many silent clients stop all the others.
class AcceptLoop {
  public:
    using Conversation = std::function<void(Connection&, Lane)>;

    AcceptLoop(const HttpLimits& limits, Conversation conversation);
    ~AcceptLoop();
    AcceptLoop(const AcceptLoop&) = delete;
    AcceptLoop& operator=(const AcceptLoop&) = delete;

    /// Takes the listening socket over. Returns after stop(). Call it once.
    void run(int listening_socket);

    /// No more connections; those that wait for a request end. May be called from any thread.
    void stop();

    bool is_stopping() const;
    std::size_t open_connections() const;

    /// Ends all connections, whatever they are at.
    void abandon();

  private:
    struct Shared;  // outlives the loop with the last of its connections
    void accept_one(int listening_socket);
    void take(int socket);

    std::shared_ptr<Shared> shared_;
};

}  // namespace patchlight::server
