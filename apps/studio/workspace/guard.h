// Access control of the studio: only the page with the token, under this machine's own names, is admitted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ombre::studio {

// Returns 32 random hexadecimal digits from the system. Throws Error.
std::string random_token();

// The parts of a request's head that decide about admission; empty if a header is missing.
struct RequestHead {
  std::string method, target, host, origin, cookie, authorization;
};

struct Refusal {
  unsigned status = 403;  // HTTP status
  std::string text;       // text for the user
};

class Guard {
 public:
  Guard(std::string token, uint16_t port) : token_(std::move(token)), port_(port) {}

  // Returns null if the request is admitted. Checks in this order:
  //   Host    It must be a name of this machine (127.0.0.1, localhost, [::1]); any port is allowed, because a
  //           tunnel may have another. Foreign names that point here (DNS rebinding) are refused.
  //   Origin  It must be absent, or the page's own: http:// and the same host.
  //   token   It must be in the cookie, in the address (?token=) or in "Authorization: Bearer".
  std::optional<Refusal> refuse(const RequestHead& head) const;

  // Returns true for GET /?token=..., whose answer sets the cookie.
  bool brings_token(std::string_view target) const;
  std::string cookie() const;  // the value of Set-Cookie

 private:
  std::string cookie_name() const { return "ombre_studio_" + std::to_string(port_); }
  bool is_token(std::string_view text) const;
  bool knows_token(const RequestHead& head) const;

  std::string token_;
  uint16_t port_;
};

// path_of() returns "/a/b" for "/a/b?c=d"; query_value() returns the value of a key in the query, or an empty text.
std::string_view path_of(std::string_view target);
std::string_view query_value(std::string_view target, std::string_view key);

}  // namespace ombre::studio
