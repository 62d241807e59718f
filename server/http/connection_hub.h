// SPDX-License-Identifier: GPL-3.0-or-later
// Connections between requests. One thread waits for the heads (and short bodies) of all of them, so that slow or
// silent clients hold no worker thread; complete requests go to a pool of workers.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "server/http/head_guard.h"

namespace toile::http {

struct HubLimits {
  HeadLimits head;
  int workers = 32;                     // requests answered at a time
  std::size_t connections = 512;        // beyond it the longest waiting one is closed
  std::int64_t short_body = 64 << 10;   // bodies up to here are awaited before a worker is taken
  std::chrono::seconds head_time{10};   // from the first byte of a request to its end (short bodies included)
  std::chrono::seconds idle_time{30};   // between requests
  std::chrono::seconds linger_time{2};  // after a refusal, for the client to read it
};

struct Connection {
  int socket = -1;
  std::string buffer;  // bytes that came and were not consumed
  Head head;           // of the request at the front of `buffer`
  std::string remote;
  int remote_port = 0;
  enum class State { Waiting, Lingering } state = State::Waiting;
  std::chrono::steady_clock::time_point deadline;
  bool started = false;  // a request's first byte has come

  ~Connection();
};

class ConnectionHub {
 public:
  // `serve` answers one request and says whether the connection may be used again. `refuse` makes the text of a
  // refusal.
  ConnectionHub(HubLimits limits, std::function<bool(Connection&)> serve,
                std::function<std::string(const Problem&, const Connection&)> refuse);
  ~ConnectionHub();
  ConnectionHub(const ConnectionHub&) = delete;
  ConnectionHub& operator=(const ConnectionHub&) = delete;

  void add(int socket);
  // Closes waiting connections and lets the workers end what they answer.
  void stop();

 private:
  using Pointer = std::unique_ptr<Connection>;
  void wait_for_heads();
  void work();
  void watch(Pointer connection);
  void take_returned();
  void receive(Connection& connection);
  void advance(Connection& connection);
  void dispatch(Connection& connection);
  void refuse(Connection& connection, const Problem& problem);
  void close_overdue();
  void make_room();
  void wake();

  const HubLimits limits_;
  const std::function<bool(Connection&)> serve_;
  const std::function<std::string(const Problem&, const Connection&)> refuse_;
  int epoll_ = -1;
  int wake_ = -1;
  std::atomic<bool> stopping_{false};

  std::map<int, Pointer> waiting_;  // by socket; only the waiting thread touches it

  std::mutex lock_;
  std::condition_variable ready_;
  std::deque<Pointer> to_serve_;
  std::deque<Pointer> returned_;  // to be watched again
  std::vector<std::thread> workers_;
  std::thread waiter_;
};

}  // namespace toile::http
