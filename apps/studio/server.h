// Serves the studio on this machine: its page by HTTP, its requests by a WebSocket.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "base/system/progress.h"
#include "studio/assets.h"
#include "studio/studio.h"

namespace ombre::studio {

struct ServerLimits {
  size_t connections = 64;  // beyond it, the connections that have been silent for longest are closed
  size_t pages = 16;        // number of WebSockets
  double head_seconds = 10;
  size_t head_bytes = 8 << 10, body_bytes = 16 << 10;  // greatest size of an HTTP request
  size_t frame_bytes = 16 << 20;                       // greatest size of a message from a page
  size_t waiting_bytes = 256 << 20;                    // greatest size of messages that a page has not taken yet
};

struct ServerOptions {
  uint16_t port = 0;  // 0: a free one
  std::string token;  // empty: a random one
  std::span<const Asset> assets;
  ServerLimits limits = {};
  double idle_seconds = 0;  // the server ends after this time without a page or a job; 0: never
};

// The address at which the server listens.
struct Address {
  uint16_t port = 0;
  std::string token;

  std::string url() const;  // opens the page
};

// Serves 127.0.0.1 until it is asked to stop, and calls `ready` once it listens. Throws Error if the port is taken.
void serve(Studio& studio, const ServerOptions& options, const StopFlag& stop,
           const std::function<void(const Address&)>& ready);

}  // namespace ombre::studio
