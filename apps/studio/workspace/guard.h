// Decides who may talk to the studio: a page that has the token, under this machine's own names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ombre::studio {

// Returns 32 random hexadecimal digits, from the system. Throws Error.
std::string random_token();

// The parts of a request's head that decide whether it is let in; empty if a header is missing.
struct RequestHead {
  std::string method, target, host, origin, cookie, authorization;
};

struct Refusal {
  unsigned status = 403;  // HTTP status
  std::string text;       // message for people
};

class Guard {
 public:
  Guard(std::string token, uint16_t port) : token_(std::move(token)), port_(port) {}

  // Returns nothing when the request is let in. Three things are checked in this order:
  // - Host is a name of this machine (127.0.0.1, localhost, [::1]). Any port will do, since a tunnel may have another.
  //   Foreign names that point here (DNS rebinding) are refused.
  // - Origin is absent, or the page's own: http:// and the same host.
  // - The token is in the cookie, in the address (?token=) or in "Authorization: Bearer".
  std::optional<Refusal> refuse(const RequestHead& head) const;

  // True for GET /?token=..., whose answer sets the cookie.
  bool brings_token(std::string_view target) const;
  std::string cookie() const;  // the value of Set-Cookie

 private:
  std::string cookie_name() const { return "ombre_studio_" + std::to_string(port_); }
  bool is_token(std::string_view text) const;
  bool knows_token(const RequestHead& head) const;

  std::string token_;
  uint16_t port_;
};

// path_of returns "/a/b" of "/a/b?c=d". The other function returns the value of a key there; empty if it is absent.
std::string_view path_of(std::string_view target);
std::string_view query_value(std::string_view target, std::string_view key);

}  // namespace ombre::studio
