#pragma once

#include "server/http/http_application.h"
#include "server/http/http_limits.h"

#include <memory>

namespace patchlight::server {

/// An HTTP/1.1 server that can stand on its own in front of strangers: everything a client can
/// make large or slow has a limit, and whatever it sends gets an answer or a closed connection.
/// cpp-httplib, which has few such limits, is given heads that are made for it and a stream that is
/// bounded; no other file knows it.
class HardenedServer {
  public:
    /// The application has to outlive it.
    HardenedServer(HttpApplication& application, const HttpLimits& limits);
    ~HardenedServer();

    /// Serves until stop(). Takes the listening socket over. Call it once.
    void run(int listening_socket);

    /// Ends run() and connections that wait for a request; the others end with their answer. May
    /// be called from any thread.
    void stop();

    std::size_t open_connections() const;

    /// Ends all connections, whatever they are at.
    void abandon();

  private:
    class Library;
    std::unique_ptr<Library> library_;
};

/// Whether this program and cpp-httplib agree on where the members of a request are. They do not
/// if one was compiled with other macros (those pkg-config names) than the other; both would then
/// write over each other's memory.
bool library_layout_matches();

}  // namespace patchlight::server
