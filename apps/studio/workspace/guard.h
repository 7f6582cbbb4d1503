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
  std::string method, target, host, origin, authorization;
};

struct Refusal {
  unsigned status = 403;  // HTTP status
  std::string text;       // text for the user
};

// The token is never in a cookie: browsers send cookies to every port of a host, so also to servers of other users.
class Guard {
 public:
  explicit Guard(std::string token) : token_(std::move(token)) {}

  // Returns null if the request comes from this machine's own page or from a program. Checks in this order:
  //   Host    It must be a name of this machine (127.0.0.1, localhost, [::1]); any port is allowed, because a
  //           tunnel may have another. Foreign names that point here (DNS rebinding) are refused.
  //   Origin  It must be absent, or the page's own: http:// and the same host.
  static std::optional<Refusal> refuse_foreign(const RequestHead& head);
  // Checks the same, and that the request has the token in its address (?token=) or in "Authorization: Bearer".
  std::optional<Refusal> refuse(const RequestHead& head) const;

 private:
  bool is_token(std::string_view text) const;
  bool knows_token(const RequestHead& head) const;

  std::string token_;
};

// path_of() returns "/a/b" for "/a/b?c=d"; query_value() returns the value of a key in the query, or an empty text.
std::string_view path_of(std::string_view target);
std::string_view query_value(std::string_view target, std::string_view key);

}  // namespace ombre::studio
