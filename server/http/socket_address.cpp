#include "server/http/socket_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace patchlight::server {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses look_up(const std::string& host, int port) {
    addrinfo wanted{};
    wanted.ai_family = AF_UNSPEC;
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int failure = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
    if (failure != 0)
        throw std::runtime_error("host " + host + " is unknown: " + ::gai_strerror(failure));
    return {found, &::freeaddrinfo};
}

bool is_loopback(const sockaddr* address) {
    if (address->sa_family == AF_INET) {
        sockaddr_in four{};
        std::memcpy(&four, address, sizeof four);
        return ntohl(four.sin_addr.s_addr) >> 24 == 127;
    }
    sockaddr_in6 six{};
    std::memcpy(&six, address, sizeof six);
    return IN6_IS_ADDR_LOOPBACK(&six.sin6_addr);
}

int port_of(int socket) {
    sockaddr_storage own{};
    socklen_t size = sizeof own;
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size);
    std::array<char, 8> digits{};
    ::getnameinfo(reinterpret_cast<const sockaddr*>(&own), size, nullptr, 0, digits.data(),
                  digits.size(), NI_NUMERICSERV);
    return std::atoi(digits.data());
}

int listening_socket(const addrinfo& address) {
    const int socket = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return -1;
    // A restart need not wait for connections of the past; two servers on one port stay an error.
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    constexpr int backlog = 512;
    if (::bind(socket, address.ai_addr, address.ai_addrlen) == 0 && ::listen(socket, backlog) == 0)
        return socket;
    const int problem = errno;
    ::close(socket);
    errno = problem;
    return -1;
}

}  // namespace

std::string peer_address(int socket) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    std::array<char, 64> text{};
    const auto* const address = reinterpret_cast<const sockaddr*>(&peer);
    if (::getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &size) != 0 ||
        ::getnameinfo(address, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0)
        return "?";
    return text.data();
}

Listener listen_on(const std::string& host, int port) {
    const Addresses addresses = look_up(host, port);
    int problem = 0;
    for (const addrinfo* each = addresses.get(); each; each = each->ai_next) {
        const int socket = listening_socket(*each);
        if (socket >= 0) return {socket, port_of(socket), is_loopback(each->ai_addr)};
        problem = errno;
    }
    const std::string place = host + " port " + std::to_string(port);
    if (problem == EADDRINUSE)
        throw std::runtime_error(place + " is in use by another program; choose one with --port");
    throw std::runtime_error("cannot listen on " + place + ": " + std::strerror(problem));
}

int connect_to(const std::string& host, int port) {
    const Addresses addresses = look_up(host, port);
    for (const addrinfo* each = addresses.get(); each; each = each->ai_next) {
        const int socket = ::socket(each->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (socket < 0) continue;
        if (::connect(socket, each->ai_addr, each->ai_addrlen) == 0) return socket;
        ::close(socket);
    }
    return -1;
}

}  // namespace patchlight::server
