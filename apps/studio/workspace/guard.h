// Who may talk to the studio: the page that has the token, from this machine's own names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ombre::studio {

// 32 random hexadecimal digits, from the system. Throws Error.
std::string random_token();

// The parts of a request's head that decide whether it is let in; empty where a header is missing.
struct RequestHead {
  std::string method, target, host, origin, cookie, authorization;
};

struct Refusal {
  unsigned status = 403;  // of HTTP
  std::string text;       // for the person who reads it
};

class Guard {
 public:
  Guard(std::string token, uint16_t port) : token_(std::move(token)), port_(port) {}

  // Nothing when the request is let in. Checked in this order:
  //   Host    a name of this machine (127.0.0.1, localhost, [::1]), with any port, since a tunnel may have another:
  //           names that others make point here (DNS rebinding) are refused
  //   Origin  absent, or the page's own: http:// and the same host
  //   token   in the cookie, in the address (?token=) or as "Authorization: Bearer"
  std::optional<Refusal> refuse(const RequestHead& head) const;

  // Whether this is GET /?token=..., whose answer sets the cookie.
  bool brings_token(std::string_view target) const;
  std::string cookie() const;  // the value of Set-Cookie

 private:
  std::string cookie_name() const { return "ombre_studio_" + std::to_string(port_); }
  bool is_token(std::string_view text) const;
  bool knows_token(const RequestHead& head) const;

  std::string token_;
  uint16_t port_;
};

// "/a/b" of "/a/b?c=d"; the value of a key there, empty when it is absent.
std::string_view path_of(std::string_view target);
std::string_view query_value(std::string_view target, std::string_view key);

}  // namespace ombre::studio
