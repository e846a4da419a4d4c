#include "server/http/hardened_server.h"

#include "server/http/body_budget.h"
#include "server/http/conversation.h"

#include <httplib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace patchlight::server {
namespace {

/// The library's handlers get its own types alone, so this is how they find the exchange.
thread_local Exchange* current = nullptr;

/// All of a head that concerns the library: where the body ends. It acts upon other fields, each
/// version upon others: ranges multiply an answer or have it refused, compression multiplies the
/// work or the body, forms are parsed. The application has the fields as they were sent.
std::string library_head(const RequestHead& head) {
    std::string text = head.method + ' ' + head.target + " HTTP/1.1\r\n";
    if (head.has_length) text += "Content-Length: " + std::to_string(head.content_length) + "\r\n";
    if (head.is_chunked) text += "Transfer-Encoding: chunked\r\n";
    return text + "\r\n";
}

/// What the library reads: a head made for it, then the body within its limits.
class CheckedStream final : public httplib::Stream {
  public:
    CheckedStream(Exchange& exchange, std::string_view head) : exchange_(exchange), head_(head) {}

    bool is_readable() const override { return true; }
    bool is_writable() const override { return !exchange_.connection.has_failed(); }

    ssize_t read(char* bytes, std::size_t count) override {
        if (head_.empty()) return read_body(bytes, count);
        const std::size_t taken = std::min(count, head_.size());
        std::memcpy(bytes, head_.data(), taken);
        head_.remove_prefix(taken);
        return static_cast<ssize_t>(taken);
    }

    ssize_t write(const char* bytes, std::size_t count) override {
        return exchange_.connection.write({bytes, count}) ? static_cast<ssize_t>(count) : -1;
    }

    void get_remote_ip_and_port(std::string& address, int& port) const override {
        address = exchange_.request.remote;
        port = 0;
    }

    void get_local_ip_and_port(std::string& address, int& port) const override {
        address.clear();
        port = 0;
    }

    socket_t socket() const override { return INVALID_SOCKET; }

  private:
    ssize_t read_body(char* bytes, std::size_t count) {
        if (!exchange_.head.has_body()) return 0;
        if (std::exchange(exchange_.head.expects_continue, false) &&
            !exchange_.connection.write("HTTP/1.1 100 Continue\r\n\r\n"))
            return -1;
        const auto read = exchange_.connection.read_body(bytes, count);
        const bool is_sound = read <= 0 || !exchange_.head.is_chunked ||
                              exchange_.chunks.accepts({bytes, static_cast<std::size_t>(read)});
        return is_sound ? read : -1;
    }

    Exchange& exchange_;
    std::string_view head_;
};

/// A request in memory; the answer to it is dropped.
class TextStream final : public httplib::Stream {
  public:
    explicit TextStream(std::string_view text) : text_(text) {}

    bool is_readable() const override { return true; }
    bool is_writable() const override { return true; }
    ssize_t read(char* bytes, std::size_t count) override {
        const std::size_t taken = text_.copy(bytes, count);
        text_.remove_prefix(taken);
        return static_cast<ssize_t>(taken);
    }
    ssize_t write(const char*, std::size_t count) override { return static_cast<ssize_t>(count); }
    void get_remote_ip_and_port(std::string&, int&) const override {}
    void get_local_ip_and_port(std::string&, int&) const override {}
    socket_t socket() const override { return INVALID_SOCKET; }

  private:
    std::string_view text_;
};

/// Takes requests from any stream, where the library has its own.
class OpenedServer final : public httplib::Server {
  public:
    void process(httplib::Stream& stream) { process_with(*this, stream); }

  private:
    /// A template, so that the call the library does not have is not looked at.
    template <typename Self>
    static void process_with(Self& self, httplib::Stream& stream) {
        constexpr bool closes = false;  // said by put_framing
        bool peer_closes = false;
        const std::function<void(httplib::Request&)> set_up = nullptr;
        if constexpr (requires { self.process_request(stream, closes, peer_closes, set_up); })
            self.process_request(stream, closes, peer_closes, set_up);
        else  // since 0.15 or so it wants to know both addresses
            self.process_request(stream, "", 0, "", 0, closes, peer_closes, set_up);
    }
};

void put(HttpAnswer answer, httplib::Response& response) {
    current->set_answer(std::move(answer));
    response.status = current->answer.status;
    response.body = std::move(current->answer.body);
    response.headers.clear();
    if (!current->answer.content_type.empty())
        response.headers.emplace("Content-Type", current->answer.content_type);
    for (const auto& [name, value] : current->answer.fields) response.headers.emplace(name, value);
}

/// The last word on the header fields, after the library's own.
void put_framing(httplib::Response& response) {
    for (const char* name : {"Connection", "Keep-Alive", "Accept-Ranges"})
        response.headers.erase(name);
    if (response.status == 204) response.headers.erase("Content-Length");
    if (current->closes()) response.headers.emplace("Connection", "close");
}

}  // namespace

class HardenedServer::Library {
  public:
    Library(HttpApplication& application, const HttpLimits& limits)
        : application_(application),
          limits_(limits),
          bodies_(limits.all_body_bytes),
          conversation_(application, limits, [this](Exchange& exchange) { answer(exchange); }),
          loop_(limits, [this](Connection& connection, Lane lane) {
              conversation_.hold(connection, lane);
          }) {
        set_handlers();
    }

    AcceptLoop& loop() { return loop_; }

  private:
    using Outcome = httplib::Server::HandlerResponse;

    void set_handlers() {
        server_.set_pre_routing_handler([this](const httplib::Request& request,
                                               httplib::Response& response) {
            return answer_without_body(request, response) ? Outcome::Handled : Outcome::Unhandled;
        });
        // Only paths that the application has admitted get here: the pattern is not for choosing.
        server_.Post("/.*", [this](const httplib::Request&, httplib::Response& response,
                                   const httplib::ContentReader& read) {
            put(*contained([&] { return answer_with_body(read); }), response);
        });
        server_.set_post_routing_handler(
            [](const httplib::Request&, httplib::Response& response) { put_framing(response); });
        server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (!current->is_answered) put(answer_of(unreadable_request()), response);
        });
        server_.set_exception_handler(
            [](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
                put(answer_of(failure_here()), response);
            });
    }

    /// The library lets exceptions out of some of its callbacks, which would end the program.
    void answer(Exchange& exchange) {
        const std::string head = library_head(exchange.head);
        CheckedStream stream(exchange, head);
        current = &exchange;
        try {
            if (is_known_method(exchange.head.method))
                server_.process(stream);
            else
                refuse_unknown_method(exchange);
        } catch (const std::exception& failure) {
            application_.failed(exchange.request, failure.what());
            exchange.must_close = true;
        }
        current = nullptr;
    }

    static bool is_known_method(const std::string& method) {
        constexpr std::array known{"GET",     "HEAD",    "POST",  "PUT",  "DELETE",
                                   "OPTIONS", "CONNECT", "TRACE", "PATCH"};
        return std::find(known.begin(), known.end(), method) != known.end();
    }

    /// The application says what it would take instead, which the library does not know.
    void refuse_unknown_method(Exchange& exchange) {
        const std::string& target = exchange.head.target;
        exchange.request.path = target.substr(0, target.find('?'));
        const std::optional<HttpAnswer> refusal =
            contained([&] { return application_.admit(exchange.request); });
        exchange.set_answer(refusal ? *refusal : answer_of(unreadable_request()));
        exchange.must_close = true;
        exchange.connection.write(closing_answer_text(exchange.answer));
    }

    /// What the application throws is answered by 500.
    template <typename Work>
    std::optional<HttpAnswer> contained(const Work& work) {
        try {
            return work();
        } catch (const std::exception& failure) {
            application_.failed(current->request, failure.what());
        } catch (...) {
            application_.failed(current->request, "an exception of unknown type");
        }
        return answer_of(failure_here());
    }

    /// False if the body has to be read first.
    bool answer_without_body(const httplib::Request& request, httplib::Response& response) {
        HttpRequest& own = current->request;
        own.path = request.path;
        own.query.assign(request.params.begin(), request.params.end());
        const auto answer = contained([&]() -> std::optional<HttpAnswer> {
            if (auto refusal = application_.admit(own)) return refusal;
            if (own.announced_length > limits_.body_bytes)
                return answer_of(body_problem(*current, true));
            if (own.has_body && own.method == "POST") return std::nullopt;
            return application_.answer(own);
        });
        if (answer) put(*answer, response);
        return answer.has_value();
    }

    std::optional<HttpAnswer> answer_with_body(const httplib::ContentReader& read) {
        std::string& body = current->request.body;
        BodyBudget::Share share(bodies_);
        bool is_over = false;
        bool is_affordable = share.take(current->request.announced_length);
        body.reserve(is_affordable ? current->request.announced_length : 0);
        const bool is_whole = read([&](const char* bytes, std::size_t count) {
            is_over = is_over || body.size() + count > limits_.body_bytes;
            if (current->head.is_chunked) is_affordable = is_affordable && share.take(count);
            if (!is_over && is_affordable) body.append(bytes, count);
            return !is_over && is_affordable;
        });
        if (is_over || (!is_whole && is_affordable))
            return answer_of(body_problem(*current, is_over));
        if (!is_affordable) return try_again_later(bodies_problem(), 1.0);
        return application_.answer(current->request);
    }

    HttpApplication& application_;
    HttpLimits limits_;
    BodyBudget bodies_;
    OpenedServer server_;
    Conversation conversation_;
    AcceptLoop loop_;
};

HardenedServer::HardenedServer(HttpApplication& application, const HttpLimits& limits)
    : library_(std::make_unique<Library>(application, limits)) {
    if (!library_layout_matches())
        throw std::logic_error("cpp-httplib was built with other macros than this program");
}

HardenedServer::~HardenedServer() = default;

void HardenedServer::run(int listening_socket) { library_->loop().run(listening_socket); }

void HardenedServer::stop() { library_->loop().stop(); }

std::size_t HardenedServer::open_connections() const { return library_->loop().open_connections(); }

void HardenedServer::abandon() { library_->loop().abandon(); }

bool library_layout_matches() {
    // A member behind those that come and go with macros, in a request that the library has made.
    bool matches = false;
    OpenedServer server;
    server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response&) {
        matches = request.redirect_count_ == CPPHTTPLIB_REDIRECT_MAX_COUNT &&
                  request.content_length_ == 0 && !request.is_chunked_content_provider_;
        return httplib::Server::HandlerResponse::Handled;
    });
    TextStream stream("GET / HTTP/1.1\r\n\r\n");
    server.process(stream);
    return matches;
}

}  // namespace patchlight::server
