// Serves the studio to this machine only: its page by HTTP, its requests by a WebSocket.
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
  size_t connections = 64;  // beyond it, the connections that have been silent longest are closed
  size_t pages = 16;        // WebSockets
  double head_seconds = 10;
  size_t head_bytes = 8 << 10, body_bytes = 16 << 10;  // limits of an HTTP request
  size_t frame_bytes = 16 << 20;                       // limit of a message from a page
  size_t waiting_bytes = 256 << 20;                    // limit of data that a page has not received yet
  double download_seconds = 3600;                      // time in which a page receives a file
};

struct ServerOptions {
  uint16_t port = 0;        // 0: the usual one, or the next free one after it
  uint16_t usual_port = 0;  // 0: any free port
  std::string token;        // empty: a random one
  std::span<const Asset> assets;
  ServerLimits limits = {};
  double idle_seconds = 0;  // the server stops after this time without a page or a job; 0: never
};

// The address at which the server listens.
struct Address {
  uint16_t port = 0;
  std::string token;
  uint16_t wanted_port = 0;  // the port that was asked for first; 0 for any

  std::string url() const;  // the address that opens the page
};

// Serves on 127.0.0.1 until a stop is requested; calls `ready` once it listens. Throws Error if the port is in use.
void serve(Studio& studio, const ServerOptions& options, const StopFlag& stop,
           const std::function<void(const Address&)>& ready);

}  // namespace ombre::studio
