// Reads words and numbers from a text format; messages point at the invalid word.
#include "formats/containers/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/text/text.h"
#include "formats/containers/greatest_coordinate.h"

namespace ombre::formats {
namespace {

// Size of a text above which copying it for one message is too expensive.
constexpr size_t most_quotable_bytes = size_t{64} << 20;

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 && !is_blank(c) && !is_line_end(c); }

// True for a number that is out of range because it is too small, not too large: from_chars reports both alike.
bool is_tiny(std::string_view number) {
  const size_t e = number.find_first_of("eE");
  return e == std::string_view::npos || number.substr(e + 1, 1) == "-";
}

// Returns the C spelling of a number in FORTRAN's form (1.5D+02, 1.5+102) or with one decimal comma; empty if it is
// neither.
std::string usual_spelling(std::string_view number) {
  constexpr size_t longest = 64;
  if (number.empty() || number.size() > longest) return {};
  std::string usual(number);
  if (std::count(usual.begin(), usual.end(), ',') == 1 && usual.find('.') == std::string::npos)
    usual[usual.find(',')] = '.';
  const size_t letter = usual.find_first_of("dD");
  const size_t sign = usual.find_first_of("+-", 1);
  if (letter != std::string::npos)
    usual[letter] = 'e';
  else if (sign != std::string::npos && usual[sign - 1] != 'e' && usual[sign - 1] != 'E')
    usual.insert(sign, 1, 'e');
  return usual;
}

}  // namespace

void fail(Diagnostics& diagnostics, const std::string& name, const std::string& message, std::string hint) {
  diagnostics.error({make_source(name, ""), 0, 0}, message, std::move(hint));
  throw DesignError();
}

std::string quoted(std::string_view word, size_t longest) {
  std::string text = "\"";
  for (const char c : word.substr(0, longest))
    text += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
  if (word.size() > longest) text += "...";
  return text + '"';
}

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  return bytes.starts_with(byte_order_mark) ? bytes.substr(byte_order_mark.size()) : bytes;
}

TextScanner::TextScanner(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, Syntax syntax)
    : name_(name), bytes_(bytes), diagnostics_(diagnostics), syntax_(syntax) {
  at_ = bytes_.size() - without_byte_order_mark(bytes_).size();
}

bool TextScanner::skip_continuation() {
  if (!syntax_.continues_lines || at_ + 1 >= bytes_.size() || bytes_[at_] != '\\') return false;
  if (!is_line_end(bytes_[at_ + 1])) return false;
  const bool two = bytes_[at_ + 1] == '\r' && at_ + 2 < bytes_.size() && bytes_[at_ + 2] == '\n';
  at_ += two ? 3 : 2;
  return true;
}

void TextScanner::skip_blanks() {
  while (at_ < bytes_.size()) {
    const char c = bytes_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (c == '\\' && skip_continuation()) {
      continue;
    } else if (syntax_.comment != '\0' && c == syntax_.comment) {
      while (at_ < bytes_.size() && !is_line_end(bytes_[at_])) ++at_;
      return;
    } else {
      return;
    }
  }
}

bool TextScanner::at_line_end() {
  skip_blanks();
  return at_ >= bytes_.size() || is_line_end(bytes_[at_]);
}

bool TextScanner::at_end() {
  while (at_line_end()) {
    if (at_ >= bytes_.size()) return true;
    ++at_;
  }
  return false;
}

void TextScanner::next_line() {
  while (at_ < bytes_.size() && !is_line_end(bytes_[at_]))
    if (!skip_continuation()) ++at_;
  if (at_ >= bytes_.size()) return;
  const bool two = bytes_[at_] == '\r' && at_ + 1 < bytes_.size() && bytes_[at_ + 1] == '\n';
  at_ += two ? 2 : 1;
}

bool TextScanner::has_lines(uint64_t count) const {
  TextScanner ahead(*this);
  for (uint64_t found = 0; found < count; ++found) {
    if (ahead.at_end()) return false;
    ahead.next_line();
  }
  return true;
}

std::string_view TextScanner::word_in_line() {
  skip_blanks();
  word_begin_ = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && !is_line_end(bytes_[at_])) {
    const char c = bytes_[at_];
    if (syntax_.comment != '\0' && c == syntax_.comment) break;
    if (c == '\\' && syntax_.continues_lines && at_ + 1 < bytes_.size() && is_line_end(bytes_[at_ + 1])) break;
    ++at_;
  }
  word_end_ = at_;
  return bytes_.substr(word_begin_, word_end_ - word_begin_);
}

std::string_view TextScanner::word() {
  if (!at_end()) return word_in_line();
  word_begin_ = word_end_ = at_;
  return {};
}

std::string_view TextScanner::rest_of_line() {
  skip_blanks();
  word_begin_ = at_;
  while (at_ < bytes_.size() && !is_line_end(bytes_[at_])) ++at_;
  word_end_ = at_;
  return trim(bytes_.substr(word_begin_, word_end_ - word_begin_));
}

double TextScanner::number(std::string_view what) {
  std::string_view text = word();
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status == std::errc() && stop == end) return value;
  if (status == std::errc::result_out_of_range && stop == end)
    return is_tiny(text) ? 0 : std::numeric_limits<double>::infinity();
  return unusual_number(text, what);
}

double TextScanner::unusual_number(std::string_view text, std::string_view what) {
  const std::string usual = usual_spelling(text);
  double value = 0;
  const char* const end = usual.data() + usual.size();
  const auto [stop, status] = std::from_chars(usual.data(), end, value);
  if (usual.empty() || status != std::errc() || stop != end) fail_number(what);
  if (text.find(',') != std::string_view::npos && !has_commas_) {
    has_commas_ = true;
    diagnostics_.warning({},
                         name_ + ": " + quoted(text) + " is taken for a number with a decimal comma, as are others");
  }
  return value;
}

double TextScanner::coordinate(std::string_view what) {
  const double value = number(what);
  if (std::abs(value) <= greatest_coordinate) return value + 0.0;  // maps -0 to 0
  const std::string_view text = bytes_.substr(word_begin_, word_end_ - word_begin_);
  if (std::isnan(value))
    fail_at_word("expected " + std::string(what) + ", found " + quoted(text) + ", which is not a number");
  fail_at_word(std::string(what) + " is too large: " + quoted(text), "coordinates may go up to 1e15");
}

Vec3 TextScanner::point(std::string_view what) {
  Vec3 p;
  p.x = coordinate(what);
  p.y = coordinate(what);
  p.z = coordinate(what);
  return p;
}

uint64_t TextScanner::count(std::string_view what) {
  const std::string_view text = word();
  uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end) fail_number(what);
  return value;
}

void TextScanner::fail_number(std::string_view what) const {
  const std::string_view text = bytes_.substr(word_begin_, word_end_ - word_begin_);
  if (text.empty()) fail_here("expected " + std::string(what) + ", but the file ends here");
  fail_at_word("expected " + std::string(what) + ", found " + quoted(text));
}

void TextScanner::fail_at(size_t begin, size_t end, const std::string& message, std::string hint) const {
  size_t line_begin = begin, line_end = begin;
  while (line_begin > 0 && bytes_[line_begin - 1] != '\n') --line_begin;
  while (line_end < bytes_.size() && bytes_[line_end] != '\n') ++line_end;
  const bool is_text = std::none_of(bytes_.begin() + line_begin, bytes_.begin() + line_end, is_control);
  if (!is_text) fail(diagnostics_, name_, message + " (at byte " + format_count(begin) + ")", std::move(hint));
  if (bytes_.size() > most_quotable_bytes) {
    const auto line = std::count(bytes_.begin(), bytes_.begin() + begin, '\n') + 1;
    fail(diagnostics_, name_ + ":" + std::to_string(line), message, std::move(hint));
  }
  const SourcePtr source = make_source(name_, std::string(bytes_));
  diagnostics_.error({source, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}, message, std::move(hint));
  throw DesignError();
}

void TextScanner::fail_at_word(const std::string& message, std::string hint) const {
  fail_at(word_begin_, word_end_, message, std::move(hint));
}

void TextScanner::fail_here(const std::string& message, std::string hint) const {
  fail_at(at_, at_, message, std::move(hint));
}

}  // namespace ombre::formats
