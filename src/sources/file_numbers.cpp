#include "sources/file_numbers.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace ombre::sources {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns the digits from `at` on without leading zeros, and moves `at` behind them.
std::string_view number_at(std::string_view text, size_t& at) {
  while (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) ++at;
  const size_t begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  return text.substr(begin, at - begin);
}

std::optional<int64_t> last_number(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  size_t begin = end;
  while (begin > 0 && is_digit(stem[begin - 1])) --begin;
  int64_t number = 0;
  const auto result = std::from_chars(stem.data() + begin, stem.data() + end, number);
  if (begin == end || result.ec != std::errc()) return std::nullopt;
  return number;
}

}  // namespace

bool is_numbered_before(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view left = number_at(a, i), right = number_at(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  const size_t left = a.size() - i, right = b.size() - j;
  return left != right ? left < right : a < b;
}

std::optional<int64_t> missing_number(const std::vector<std::string>& files) {
  std::optional<int64_t> before;
  for (const std::string& file : files) {
    const auto number = last_number(file);
    if (!number) return std::nullopt;
    if (before && *number > *before + 1) return *before + 1;
    before = number;
  }
  return std::nullopt;
}

}  // namespace ombre::sources
