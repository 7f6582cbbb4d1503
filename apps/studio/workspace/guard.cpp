#include "studio/workspace/guard.h"

#include <sys/random.h>

#include <algorithm>
#include <array>

#include "base/text/error.h"

namespace ombre::studio {
namespace {

bool is_own_name(std::string_view host) {
  const size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  const std::string_view name = has_port ? host.substr(0, colon) : host;
  const std::string_view port = has_port ? host.substr(colon + 1) : "80";
  if (port.empty() || port.size() > 5 || port.find_first_not_of("0123456789") != std::string_view::npos) return false;
  return name == "127.0.0.1" || name == "localhost" || name == "[::1]";
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error("the system gives no random numbers for the studio's token");
  constexpr const char* digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4];
    token += digits[byte & 15];
  }
  return token;
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

std::string_view query_value(std::string_view target, std::string_view key) {
  const size_t question = target.find('?');
  if (question == std::string_view::npos) return {};
  std::string_view rest = target.substr(question + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    if (pair.size() > key.size() && pair.substr(0, key.size()) == key && pair[key.size()] == '=')
      return pair.substr(key.size() + 1);
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
  }
  return {};
}

// The comparison takes the same time wherever the texts differ, so that the token cannot be guessed digit by digit.
bool Guard::is_token(std::string_view text) const {
  if (text.size() != token_.size()) return false;
  unsigned difference = 0;
  for (size_t n = 0; n < text.size(); ++n) difference |= static_cast<unsigned char>(text[n] ^ token_[n]);
  return difference == 0;
}

bool Guard::knows_token(const RequestHead& head) const {
  if (is_token(query_value(head.target, "token"))) return true;
  constexpr std::string_view bearer = "Bearer ";
  return head.authorization.starts_with(bearer) && is_token(std::string_view(head.authorization).substr(bearer.size()));
}

std::optional<Refusal> Guard::refuse_foreign(const RequestHead& head) {
  if (!is_own_name(head.host))
    return Refusal{403, "The studio answers to 127.0.0.1 and localhost alone, not to this name."};
  if (!head.origin.empty() && head.origin != "http://" + head.host)
    return Refusal{403, "The studio answers to its own page alone, not to those of others."};
  return std::nullopt;
}

std::optional<Refusal> Guard::refuse(const RequestHead& head) const {
  if (auto foreign = refuse_foreign(head)) return foreign;
  if (!knows_token(head))
    return Refusal{403,
                   "The address lacks the studio's token. Open the one that ombre studio printed when it started."};
  return std::nullopt;
}

}  // namespace ombre::studio
