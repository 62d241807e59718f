// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/library_server.h"

#include <algorithm>
#include <cerrno>
#include <fstream>

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>

#include "engine/core/error.h"
#include "server/http/router.h"

namespace toile::http {

namespace {

using Steady = std::chrono::steady_clock;

constexpr int kReadIdleMs = 10000;            // a sender silent for so long in mid-body is given up
constexpr int kWriteIdleMs = 20000;           // a reader that takes nothing for so long is given up
constexpr std::int64_t kBodySlackMs = 30000;  // a body may take so long plus its size at the slowest rate
constexpr std::int64_t kSlowestRate = 32;     // bytes per millisecond

// The library would take multipart bodies apart in memory by itself: it is not shown that a body is one.
constexpr const char* kHiddenType = "X-Toile-Content-Type";

bool ready(int socket, short events, int timeout_ms) {
  struct pollfd wanted = {socket, events, 0};
  int result = 0;
  while ((result = ::poll(&wanted, 1, timeout_ms)) < 0 && errno == EINTR) {
  }
  return result > 0;
}

// What the library reads and writes: bytes already received first, then the socket, within deadlines.
class ConnectionStream : public httplib::Stream {
 public:
  explicit ConnectionStream(Connection& connection)
      : connection_(connection),
        deadline_(Steady::now() +
                  std::chrono::milliseconds(kBodySlackMs + connection.head.content_length / kSlowestRate)) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return ready(connection_.socket, POLLOUT, kWriteIdleMs); }

  ssize_t read(char* bytes, size_t size) override {
    if (!connection_.buffer.empty()) {
      const std::size_t count = std::min(size, connection_.buffer.size() - at_);
      std::copy_n(connection_.buffer.data() + at_, count, bytes);
      at_ += count;
      consumed_ += static_cast<std::int64_t>(count);
      if (at_ == connection_.buffer.size()) drop_consumed();
      return static_cast<ssize_t>(count);
    }
    if (Steady::now() > deadline_ || !ready(connection_.socket, POLLIN, kReadIdleMs)) return -1;
    const ssize_t count = ::recv(connection_.socket, bytes, size, 0);
    if (count > 0) consumed_ += count;
    return count;
  }

  ssize_t write(const char* bytes, size_t size) override {
    if (!ready(connection_.socket, POLLOUT, kWriteIdleMs)) return -1;
    const ssize_t count = ::send(connection_.socket, bytes, size, MSG_NOSIGNAL);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    return count;
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip = connection_.remote;
    port = connection_.remote_port;
  }
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return 0; }  // only compared with the bound of select(), which is not used here

  void drop_consumed() {
    connection_.buffer.erase(0, at_);
    at_ = 0;
  }
  // Whether the whole request was taken from the connection.
  bool at_end_of_request() const {
    return consumed_ == static_cast<std::int64_t>(connection_.head.size) + connection_.head.content_length;
  }

 private:
  Connection& connection_;
  Steady::time_point deadline_;
  std::size_t at_ = 0;
  std::int64_t consumed_ = 0;
};

Request request_of(const httplib::Request& given) {
  Request request;
  request.method = given.method;
  const std::size_t question = given.target.find('?');
  request.path = given.target.substr(0, question);
  if (question != std::string::npos) request.query = parse_query(std::string_view(given.target).substr(question + 1));
  for (const auto& [name, value] : given.headers)
    request.headers.emplace(name == kHiddenType ? "Content-Type" : name, value);
  request.content_length = static_cast<std::int64_t>(given.get_header_value<std::uint64_t>("Content-Length"));
  request.remote = given.remote_addr;
  return request;
}

void send_file(const Response& response, httplib::Response& out) {
  const auto file = std::make_shared<std::ifstream>(*response.file, std::ios::binary);
  std::error_code error;
  const auto whole = static_cast<std::int64_t>(std::filesystem::file_size(*response.file, error));
  if (!*file || error) throw Error(ErrorCode::StorageFailed, "artifact", "a stored file cannot be read");
  const ByteRange range = response.range.value_or(ByteRange{0, whole - 1});
  if (range.size() == 0) return out.set_content("", response.content_type);
  const auto size = static_cast<std::size_t>(range.size());
  out.set_content_provider(size, response.content_type, [=](size_t offset, size_t length, httplib::DataSink& sink) {
    std::vector<char> piece(std::min<std::size_t>(length, 1 << 16));
    file->seekg(range.first + static_cast<std::streamoff>(offset));
    file->read(piece.data(), static_cast<std::streamsize>(piece.size()));
    return *file && sink.write(piece.data(), piece.size());
  });
}

void put_response(Response response, httplib::Response& out) {
  out.status = response.status;
  for (const auto& [name, value] : response.headers) out.headers.emplace(name, value);
  if (response.file) return send_file(response, out);
  if (response.stream) {
    const auto stream = std::make_shared<std::function<void(const StreamSink&)>>(std::move(response.stream));
    out.set_chunked_content_provider(response.content_type, [stream](size_t, httplib::DataSink& sink) {
      (*stream)([&](std::string_view text) { return sink.is_writable() && sink.write(text.data(), text.size()); });
      sink.done();
      return true;
    });
    return;
  }
  if (!response.content_type.empty()) out.set_content(response.body, response.content_type.c_str());
}

}  // namespace

struct LibraryServer::Implementation : httplib::Server {
  // Runs what the acceptor hands over at once: it only gives the socket to the hub.
  struct Inline : httplib::TaskQueue {
    void enqueue(std::function<void()> task) override { task(); }
    void shutdown() override {}
  };

  Implementation(HubLimits limits, Answer answer_, std::function<void(const Problem&, const std::string&)> observe)
      : answer(std::move(answer_)),
        hub(
            limits, [this](Connection& connection) { return serve(connection); },
            [observe](const Problem& problem, const Connection& connection) {
              observe(problem, connection.remote);
              const Response response = problem_response(problem, "");
              std::string text =
                  "HTTP/1.1 " + std::to_string(problem.status) + " " + reason_phrase(problem.status) + "\r\n";
              for (const auto& [name, value] : response.headers) text += name + ": " + value + "\r\n";
              return text + "Content-Type: application/problem+json\r\nConnection: close\r\nContent-Length: " +
                     std::to_string(response.body.size()) + "\r\n\r\n" + response.body;
            }) {
    new_task_queue = [] { return new Inline; };
    set_keep_alive_max_count(1);
    const auto plain = [this](const httplib::Request& given, httplib::Response& out) {
      Request request = request_of(given);
      request.read_body = [](const BodyReceiver&) { return true; };
      put_response(answer(request), out);
    };
    Get(".*", plain);
    Post(".*", [this](const httplib::Request& given, httplib::Response& out, const httplib::ContentReader& reader) {
      Request request = request_of(given);
      request.read_body = [&](const BodyReceiver& receive) {
        return reader([&](const char* bytes, size_t size) {
          return receive(std::span(reinterpret_cast<const std::uint8_t*>(bytes), size));
        });
      };
      put_response(answer(request), out);
    });
    // Before routing, so that a DELETE with a body is answered without reading it.
    set_pre_routing_handler([plain](const httplib::Request& given, httplib::Response& out) {
      if (given.method != "DELETE") return HandlerResponse::Unhandled;
      plain(given, out);
      return HandlerResponse::Handled;
    });
    set_tcp_nodelay(true);
    // The library would share the port with any other server that listens there.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
  }

  bool process_and_close_socket(socket_t socket) override {
    hub.add(socket);
    return true;
  }

  bool serve(Connection& connection) {
    ConnectionStream stream(connection);
    bool closed = false;
    const bool answered = process_request(stream, false, closed, [](httplib::Request& request) {
      request.headers.erase("Accept-Encoding");  // answers go out as they are stored: an ETag names those bytes
      request.ranges.clear();  // endpoints do their own: the library answers 200, and past the end with nonsense
      request.headers.erase(kHiddenType);
      const std::string type = request.get_header_value("Content-Type");
      request.headers.erase("Content-Type");
      request.headers.emplace(kHiddenType, type);
    });
    stream.drop_consumed();
    return answered && !closed && stream.at_end_of_request();
  }

  Answer answer;
  ConnectionHub hub;
};

LibraryServer::LibraryServer(HubLimits limits, Answer answer,
                             std::function<void(const Problem&, const std::string&)> observe)
    : implementation_(std::make_unique<Implementation>(limits, std::move(answer), std::move(observe))) {}

LibraryServer::~LibraryServer() = default;

int LibraryServer::bind(const std::string& host, int port) {
  const int bound = port == 0                                   ? implementation_->bind_to_any_port(host)
                    : implementation_->bind_to_port(host, port) ? port
                                                                : -1;
  if (bound <= 0)
    throw Error(ErrorCode::BadUsage, host + ":" + std::to_string(port),
                "cannot listen there: is another server running, or is this no address of this machine? choose another "
                "--port or --host");
  return bound;
}

void LibraryServer::run() {
  implementation_->listen_after_bind();
}

void LibraryServer::stop() {
  implementation_->stop();
  implementation_->hub.stop();
}

}  // namespace toile::http
