// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/connection_hub.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

namespace toile::http {

namespace {

using Steady = std::chrono::steady_clock;
constexpr int kTickMs = 200;  // resolution of the deadlines

void set_remote(Connection& connection) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (::getpeername(connection.socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.ss_family == AF_INET) {
    const auto* v4 = reinterpret_cast<const sockaddr_in*>(&address);
    ::inet_ntop(AF_INET, &v4->sin_addr, text.data(), text.size());
    connection.remote_port = ntohs(v4->sin_port);
  } else if (address.ss_family == AF_INET6) {
    const auto* v6 = reinterpret_cast<const sockaddr_in6*>(&address);
    ::inet_ntop(AF_INET6, &v6->sin6_addr, text.data(), text.size());
    connection.remote_port = ntohs(v6->sin6_port);
  }
  connection.remote = text.data();
}

}  // namespace

Connection::~Connection() {
  if (socket >= 0) ::close(socket);
}

ConnectionHub::ConnectionHub(HubLimits limits, std::function<bool(Connection&)> serve,
                             std::function<std::string(const Problem&, const Connection&)> refuse)
    : limits_(limits),
      serve_(std::move(serve)),
      refuse_(std::move(refuse)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = wake_;
  ::epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event);
  for (int i = 0; i < limits_.workers; ++i) workers_.emplace_back([this] { work(); });
  waiter_ = std::thread([this] { wait_for_heads(); });
}

ConnectionHub::~ConnectionHub() {
  stop();
  ::close(wake_);
  ::close(epoll_);
}

void ConnectionHub::stop() {
  if (stopping_.exchange(true)) return;
  wake();
  waiter_.join();
  ready_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ConnectionHub::wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof one);
}

void ConnectionHub::add(int socket) {
  auto connection = std::make_unique<Connection>();
  connection->socket = socket;
  ::fcntl(socket, F_SETFL, ::fcntl(socket, F_GETFL) | O_NONBLOCK);
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  set_remote(*connection);
  const std::lock_guard lock(lock_);
  returned_.push_back(std::move(connection));
  wake();
}

void ConnectionHub::work() {
  for (;;) {
    Pointer connection;
    {
      std::unique_lock lock(lock_);
      ready_.wait(lock, [&] { return stopping_ || !to_serve_.empty(); });
      if (to_serve_.empty()) return;
      connection = std::move(to_serve_.front());
      to_serve_.pop_front();
    }
    const bool keep = serve_(*connection);
    if (!keep) {
      // Closing with unread bytes would reset the connection under the answer: let the client read it first.
      ::shutdown(connection->socket, SHUT_WR);
      connection->state = Connection::State::Lingering;
      connection->buffer.clear();
      connection->buffer.shrink_to_fit();
    }
    if (stopping_) continue;
    const std::lock_guard lock(lock_);
    returned_.push_back(std::move(connection));
    wake();
  }
}

void ConnectionHub::take_returned() {
  std::deque<Pointer> returned;
  {
    const std::lock_guard lock(lock_);
    returned.swap(returned_);
  }
  for (Pointer& connection : returned) watch(std::move(connection));
}

void ConnectionHub::watch(Pointer connection) {
  if (waiting_.size() >= limits_.connections) make_room();
  Connection& watched = *connection;
  const bool lingering = watched.state == Connection::State::Lingering;
  watched.started = false;
  watched.deadline = Steady::now() + (lingering ? limits_.linger_time : limits_.idle_time);
  epoll_event event{};
  event.events = EPOLLIN | EPOLLRDHUP;
  event.data.fd = watched.socket;
  if (::epoll_ctl(epoll_, EPOLL_CTL_ADD, watched.socket, &event) != 0) return;
  waiting_[watched.socket] = std::move(connection);
  if (!lingering && !watched.buffer.empty()) advance(watched);  // the next request came with the last
}

void ConnectionHub::make_room() {
  const auto oldest = std::min_element(waiting_.begin(), waiting_.end(), [](const auto& a, const auto& b) {
    return a.second->deadline < b.second->deadline;
  });
  if (oldest != waiting_.end()) waiting_.erase(oldest);
}

void ConnectionHub::receive(Connection& connection) {
  std::array<char, 16384> bytes{};
  const ssize_t count = ::recv(connection.socket, bytes.data(), bytes.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) {
    waiting_.erase(connection.socket);
    return;
  }
  if (connection.state == Connection::State::Lingering) return;  // read and dropped
  connection.buffer.append(bytes.data(), static_cast<std::size_t>(count));
  advance(connection);
}

void ConnectionHub::advance(Connection& connection) {
  if (!connection.started) {
    connection.started = true;
    connection.deadline = Steady::now() + limits_.head_time;
  }
  const HeadResult result = examine_head(connection.buffer, limits_.head);
  if (result.state == HeadState::Refused) return refuse(connection, result.refusal);
  if (result.state == HeadState::Incomplete) return;
  connection.head = result.head;
  const bool short_body = result.head.content_length <= limits_.short_body && !result.head.expects_continue;
  const std::size_t wanted = result.head.size + (short_body ? static_cast<std::size_t>(result.head.content_length) : 0);
  if (connection.buffer.size() >= wanted) dispatch(connection);
}

void ConnectionHub::dispatch(Connection& connection) {
  ::epoll_ctl(epoll_, EPOLL_CTL_DEL, connection.socket, nullptr);
  const auto found = waiting_.find(connection.socket);
  Pointer owned = std::move(found->second);
  waiting_.erase(found);
  const std::lock_guard lock(lock_);
  to_serve_.push_back(std::move(owned));
  ready_.notify_one();
}

void ConnectionHub::refuse(Connection& connection, const Problem& problem) {
  const std::string text = refuse_(problem, connection);
  // A refusal fits into any socket buffer; a client that reads nothing loses it.
  [[maybe_unused]] const ssize_t sent =
      ::send(connection.socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ::shutdown(connection.socket, SHUT_WR);
  connection.state = Connection::State::Lingering;
  connection.deadline = Steady::now() + limits_.linger_time;
  connection.buffer.clear();
  connection.buffer.shrink_to_fit();
}

void ConnectionHub::close_overdue() {
  const auto now = Steady::now();
  std::vector<Connection*> overdue;
  for (const auto& [socket, connection] : waiting_)
    if (connection->deadline < now) overdue.push_back(connection.get());
  for (Connection* connection : overdue) {
    const bool late = connection->state == Connection::State::Waiting && connection->started;
    if (late)
      refuse(*connection, {408, "request_timeout", "the request did not arrive in time", {}, {}});
    else
      waiting_.erase(connection->socket);
  }
}

void ConnectionHub::wait_for_heads() {
  std::array<epoll_event, 64> events{};
  auto next_check = Steady::now();
  while (!stopping_) {
    const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), kTickMs);
    for (int i = 0; i < count; ++i) {
      const int socket = events[static_cast<std::size_t>(i)].data.fd;
      if (socket == wake_) {
        std::uint64_t drained = 0;
        [[maybe_unused]] const ssize_t got = ::read(wake_, &drained, sizeof drained);
        continue;
      }
      const auto found = waiting_.find(socket);
      if (found != waiting_.end()) receive(*found->second);
    }
    take_returned();
    if (Steady::now() >= next_check) {
      close_overdue();
      next_check = Steady::now() + std::chrono::milliseconds(kTickMs);
    }
  }
  waiting_.clear();
}

}  // namespace toile::http
