// The studio on the network of this machine alone: its page by HTTP, its requests by a WebSocket.
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
  size_t connections = 64;  // with more, those that have said nothing for the longest time are closed
  size_t pages = 16;        // WebSockets
  double head_seconds = 10;
  size_t head_bytes = 8 << 10, body_bytes = 16 << 10;  // of an HTTP request
  size_t frame_bytes = 16 << 20;                       // of what a page says
  size_t waiting_bytes = 256 << 20;                    // that a page has not yet taken
};

struct ServerOptions {
  uint16_t port = 0;  // 0: one that is free
  std::string token;  // empty: a random one
  std::span<const Asset> assets;
  ServerLimits limits = {};
  double idle_seconds = 0;  // it ends after so long without a page or a job; 0: never
};

// The address at which the server listens.
struct Address {
  uint16_t port = 0;
  std::string token;

  std::string url() const;  // that opens the page
};

// Serves 127.0.0.1 until asked to stop, after `ready` was called. Throws Error when the port is taken.
void serve(Studio& studio, const ServerOptions& options, const StopFlag& stop,
           const std::function<void(const Address&)>& ready);

}  // namespace ombre::studio
