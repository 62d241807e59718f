// SPDX-License-Identifier: GPL-3.0-or-later
// The HTTP library behind our own door: sockets come from the hub, requests go to one function. Nothing of the library
// shows here.
#pragma once

#include <memory>

#include "server/http/connection_hub.h"
#include "server/http/message.h"

namespace toile::http {

class LibraryServer {
 public:
  using Answer = std::function<Response(Request&)>;
  // `observe` is told about refusals made before a request was read.
  LibraryServer(HubLimits limits, Answer answer,
                std::function<void(const Problem&, const std::string& remote)> observe);
  ~LibraryServer();

  // Binds; port 0 takes a free one. Answers the port. Throws Error{BadUsage}: the address is taken or not ours.
  int bind(const std::string& host, int port);
  // Accepts until stop().
  void run();
  void stop();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace toile::http
