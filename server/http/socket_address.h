#pragma once

#include <string>

namespace patchlight::server {

/// The address of the peer of a connected socket, such as "127.0.0.1" or "::1"; "?" if unknown.
std::string peer_address(int socket);

/// A TCP socket that listens.
struct Listener {
    int socket = -1;
    int port = 0;             // chosen by the system if 0 was asked for
    bool is_loopback = true;  // nobody but this machine can connect
};

/// Throws std::runtime_error saying what is in the way: the port is taken, the name is unknown.
Listener listen_on(const std::string& host, int port);

/// A connected socket, or -1.
int connect_to(const std::string& host, int port);

}  // namespace patchlight::server
