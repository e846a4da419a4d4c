#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace patchlight::server {

/// What came back, taken apart no further than a test needs it.
struct RawAnswer {
    int status = 0;                             // 0: the connection ended without an answer
    std::map<std::string, std::string> fields;  // names in small letters
    std::string body;

    std::string field(const std::string& name) const;
};

/// A client that sends any bytes at all, well-formed or not.
class RawClient {
  public:
    explicit RawClient(int port);
    ~RawClient();
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    /// False once the server no longer takes it.
    bool send(std::string_view bytes);

    /// The next answer; `of_head` if it is one to HEAD, which has no body.
    RawAnswer answer(bool of_head = false);

    /// Whether there is anything to receive within that time, be it the end.
    bool receives_within(std::chrono::milliseconds most) const;

    /// Whether the server ends the connection, within some seconds, without sending more.
    bool is_closed();

    void half_close();  // FIN
    void reset();       // RST

  private:
    bool receive();

    int socket_ = -1;
    std::string received_;
};

/// One request on a connection of its own.
RawAnswer ask(int port, std::string_view request);

/// "GET <path> HTTP/1.1" with Host and what else is given, each line with its CR LF.
std::string get(const std::string& path, const std::string& fields = "");

/// The same for POST, with the length of the body.
std::string post(const std::string& path, const std::string& body,
                 const std::string& fields = "Content-Type: application/json\r\n");

}  // namespace patchlight::server
