#include "server/http/accept_loop.h"

#include "server/http/problem.h"
#include "server/http/socket_address.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace patchlight::server {

struct AcceptLoop::Shared {
    HttpLimits limits;
    Conversation conversation;
    ConnectionCount count;
    std::atomic<bool> is_stopping = false;
    std::mutex mutex;
    std::set<int> sockets;  // that are open

    Shared(const HttpLimits& its_limits, Conversation its_conversation)
        : limits(its_limits), conversation(std::move(its_conversation)), count(its_limits) {}

    /// The life of one connection, in a thread of its own. Nothing leaves it: where memory has run
    /// out before there was an answer, the connection ends without one.
    void converse(int socket, const std::string& address, Lane lane) noexcept {
        try {
            Connection connection(socket, limits, is_stopping);
            const Listed listed(*this, socket);  // for as long as the number is its own
            conversation(connection, lane);
        } catch (...) {
        }
        count.leave(address, lane);
    }

    struct Listed {
        Shared& shared;
        int socket;

        Listed(Shared& its_shared, int its_socket) : shared(its_shared), socket(its_socket) {
            const std::lock_guard lock(shared.mutex);
            shared.sockets.insert(socket);
        }
        ~Listed() {
            const std::lock_guard lock(shared.mutex);
            shared.sockets.erase(socket);
        }
        Listed(const Listed&) = delete;
        Listed& operator=(const Listed&) = delete;
    };
};

namespace {

/// Said without waiting for the request, from the thread that accepts: it must not take long.
void refuse_connection(int socket) {
    HttpAnswer answer = try_again_later({503,
                                         "too-many-connections",
                                         "Too many connections",
                                         "every connection is taken; try again",
                                         {}},
                                        1.0);
    add_common_fields("-", answer);
    const std::string text = closing_answer_text(answer);
    static_cast<void>(::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
    ::close(socket);
}

}  // namespace

AcceptLoop::AcceptLoop(const HttpLimits& limits, Conversation conversation)
    : shared_(std::make_shared<Shared>(limits, std::move(conversation))) {}

AcceptLoop::~AcceptLoop() {
    stop();
    abandon();
    shared_->count.wait_until_none();
}

void AcceptLoop::run(int listening_socket) {
    constexpr int slice = 50;  // after which stop() is noticed [ms]
    pollfd polled{listening_socket, POLLIN, 0};
    while (!shared_->is_stopping)
        if (::poll(&polled, 1, slice) > 0) accept_one(listening_socket);
    ::close(listening_socket);
}

void AcceptLoop::accept_one(int listening_socket) {
    const int socket = ::accept4(listening_socket, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket < 0) {
        // Out of file descriptors or of memory: others have to go first. All else is the peer's.
        if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return;
    }
    try {
        take(socket);
    } catch (const std::exception&) {  // no memory to be had
        ::close(socket);
    }
}

void AcceptLoop::take(int socket) {
    const std::string address = peer_address(socket);
    const Lane lane = shared_->count.enter(address);
    if (lane == Lane::refused) return refuse_connection(socket);
    try {
        std::thread([shared = shared_, socket, address, lane] {
            shared->converse(socket, address, lane);
        }).detach();
    } catch (const std::exception&) {  // no thread to be had
        shared_->count.leave(address, lane);
        refuse_connection(socket);
    }
}

void AcceptLoop::stop() { shared_->is_stopping = true; }

bool AcceptLoop::is_stopping() const { return shared_->is_stopping; }

std::size_t AcceptLoop::open_connections() const { return shared_->count.open(); }

void AcceptLoop::abandon() {
    const std::lock_guard lock(shared_->mutex);
    for (const int socket : shared_->sockets) ::shutdown(socket, SHUT_RDWR);
}

}  // namespace patchlight::server
