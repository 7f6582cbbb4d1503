#include <algorithm>
#include <charconv>

#include "formats/mesh/files_beside.h"

namespace ombre::formats {
namespace {

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

// A scheme is letters, digits and + - . before the first colon; C: begins a path of Windows.
bool has_scheme(std::string_view uri) {
  const size_t colon = uri.find_first_of(":/");
  return colon != std::string_view::npos && uri[colon] == ':' && letters.find(uri.front()) != std::string_view::npos;
}

// Returns the byte of two hexadecimal digits.
std::optional<char> byte_of(std::string_view digits) {
  unsigned value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
  if (digits.size() != 2 || error != std::errc() || stop != end) return std::nullopt;
  return static_cast<char>(value);
}

std::optional<std::string> decoded(std::string_view uri) {
  std::string path;
  for (size_t at = 0; at < uri.size(); ++at) {
    if (uri[at] != '%') {
      path += uri[at];
      continue;
    }
    const auto byte = byte_of(uri.substr(at + 1, 2));
    if (!byte) return std::nullopt;
    path += *byte;
    at += 2;
  }
  return path;
}

}  // namespace

std::optional<std::string> path_of_uri(std::string_view uri) {
  if (uri.empty() || has_scheme(uri)) return std::nullopt;
  auto path = decoded(uri);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (!path || std::ranges::any_of(*path, is_control)) return std::nullopt;
  if (path->front() == '/' || path->front() == '\\') return std::nullopt;
  return path;
}

}  // namespace ombre::formats
