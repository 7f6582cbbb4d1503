#include "lang/syntax/lexer.h"

#include <algorithm>
#include <utility>

#include "base/text/utf8.h"

namespace ombre::lang {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }
bool is_name_part(char c) { return (is_name_start(c) && c != '$') || is_digit(c); }

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF", no_break_space = "\xC2\xA0", in_latin1 = "\xA0";

std::optional<TokenKind> single_sign(char c) {
  switch (c) {
    case '(':
      return TokenKind::left_paren;
    case ')':
      return TokenKind::right_paren;
    case '[':
      return TokenKind::left_bracket;
    case ']':
      return TokenKind::right_bracket;
    case '{':
      return TokenKind::left_brace;
    case '}':
      return TokenKind::right_brace;
    case ';':
      return TokenKind::semicolon;
    case ',':
      return TokenKind::comma;
    case '.':
      return TokenKind::dot;
    case ':':
      return TokenKind::colon;
    case '?':
      return TokenKind::question;
    case '=':
      return TokenKind::assign;
    case '#':
      return TokenKind::hash;
    case '+':
      return TokenKind::plus;
    case '-':
      return TokenKind::minus;
    case '*':
      return TokenKind::star;
    case '/':
      return TokenKind::slash;
    case '%':
      return TokenKind::percent;
    case '^':
      return TokenKind::caret;
    case '!':
      return TokenKind::bang;
    case '<':
      return TokenKind::less;
    case '>':
      return TokenKind::greater;
    default:
      return std::nullopt;
  }
}

// Decodes the escapes of one string.
class Unescaper {
 public:
  Unescaper(const SourcePtr& source, const Token& token, Dialect dialect, Diagnostics& diagnostics)
      : source_(source),
        begin_(token.begin),
        text_(source->text().substr(token.begin, token.end - token.begin)),
        dialect_(dialect),
        diagnostics_(diagnostics) {}

  StringValue run() {
    const size_t end = text_.size() > 1 && text_.back() == '"' ? text_.size() - 1 : text_.size();
    for (at_ = 1; at_ < end;) {
      if (text_[at_] == '\\')
        escape();
      else
        character();
    }
    return std::move(result_);
  }

 private:
  void character() {
    const size_t size = text_[at_] == '\0' ? 0 : code_point_size(text_, at_);
    if (size == 0) return invalid_byte();
    const bool is_left_out = dialect_ == Dialect::openscad && is_line_end(text_[at_]);
    if (!is_left_out) result_.text += text_.substr(at_, size);
    at_ += size;
  }

  // OpenSCAD keeps bytes of other encodings.
  void invalid_byte() {
    const char byte = text_[at_++];
    if (dialect_ == Dialect::openscad && byte != '\0') {
      result_.text += byte;
    } else if (!was_reported_) {
      diagnostics_.error(Code::syntax, part(at_ - 1, at_), "this is not text in UTF-8",
                         "save the file as plain UTF-8 text");
      was_reported_ = true;
    }
  }

  void escape() {
    const size_t begin = at_;
    const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    at_ += 2;
    result_.is_plain = false;
    switch (c) {
      case 'n':
        result_.text += '\n';
        return;
      case 't':
        result_.text += '\t';
        return;
      case 'r':
        result_.text += '\r';
        return;
      case '"':
      case '\\':
        result_.text += c;
        return;
      case 'x':
        return code(begin, 2);
      case 'u':
        return code(begin, 4);
      case 'U':
        return code(begin, 6);
      default:
        break;
    }
    if (dialect_ == Dialect::openscad) return ignore_backslash(begin);
    // Keeps the backslash, for designs whose paths and formulas were written without escapes in mind.
    diagnostics_.warning(part(begin, begin + 1), "this backslash starts no escape and stands for itself",
                         "write \\\\ for a backslash");
    result_.text += '\\';
    at_ = begin + 1;
  }

  // OpenSCAD passes over a backslash that starts no escape.
  void ignore_backslash(size_t begin) { at_ = begin + 1; }

  void code(size_t begin, size_t digits) {
    uint32_t value = 0;
    for (size_t i = 0; i < digits; ++i, ++at_) {
      const int digit = at_ < text_.size() ? hex(text_[at_]) : -1;
      if (digit < 0 && dialect_ == Dialect::openscad) return ignore_backslash(begin);
      if (digit < 0)
        return diagnostics_.error(Code::syntax, part(begin, at_),
                                  "this escape needs " + std::to_string(digits) + " hexadecimal digits");
      value = value * 16 + static_cast<uint32_t>(digit);
    }
    if (dialect_ == Dialect::openscad) {
      if (digits == 2 && value > 0x7F) return ignore_backslash(begin);
      if (!is_code_point(value)) value = ' ';
      return append_code_point(result_.text, value);
    }
    if (!is_code_point(value) || (digits == 2 && value > 0x7F))
      return diagnostics_.error(Code::syntax, part(begin, at_), "this escape is no Unicode character",
                                digits == 2 ? "\\x goes from 01 to 7f; write \\u for other characters" : "");
    append_code_point(result_.text, value);
  }

  static int hex(char c) {
    if (is_digit(c)) return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  }

  SourceRange part(size_t from, size_t to) const {
    return {source_, begin_ + static_cast<uint32_t>(from), begin_ + static_cast<uint32_t>(to)};
  }

  const SourcePtr& source_;
  uint32_t begin_;
  std::string_view text_;
  Dialect dialect_;
  Diagnostics& diagnostics_;
  size_t at_ = 1;
  bool was_reported_ = false;
  StringValue result_;
};

}  // namespace

Token Lexer::next() {
  if (at_ == 0 && text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  for (found_.reset(); !found_;) {
    skip_blank();
    if (at_ < text_.size())
      read();
    else
      put(TokenKind::end, at_);
  }
  return *found_;
}

void Lexer::put(TokenKind kind, size_t begin) {
  found_ = Token{kind, static_cast<uint32_t>(begin), static_cast<uint32_t>(at_)};
}

void Lexer::error(size_t begin, size_t end, std::string message, Phrase hint) {
  diagnostics_.error(Code::syntax, {source_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)},
                     std::move(message), std::move(hint));
}

void Lexer::skip_blank() {
  while (at_ < text_.size()) {
    if (is_space(text_[at_])) {
      ++at_;
    } else if (const size_t size = blank_of_openscad(); size > 0) {
      at_ += size;
    } else if (peek() == '/' && peek(1) == '/') {
      at_ = std::min(text_.find_first_of(line_ends, at_), text_.size());
    } else if (peek() == '/' && peek(1) == '*') {
      skip_comment();
    } else {
      return;
    }
  }
}

// Returns the size of a blank that OpenSCAD alone takes as one, also in files that are not UTF-8.
size_t Lexer::blank_of_openscad() const {
  if (dialect_ != Dialect::openscad) return 0;
  for (const std::string_view blank : {no_break_space, byte_order_mark, in_latin1})
    if (text_.substr(at_).starts_with(blank)) return blank.size();
  return 0;
}

void Lexer::skip_comment() {
  const size_t close = text_.find("*/", at_ + 2);
  if (close == std::string_view::npos) {
    error(at_, at_ + 2, "the comment is not closed", "write */ at its end");
    is_cut_short_ = true;
    at_ = text_.size();
  } else {
    at_ = close + 2;
  }
}

void Lexer::read() {
  const char c = peek();
  if (is_name_start(c)) return name();
  if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number();
  if (c == '"') return string();
  sign();
}

void Lexer::name() {
  const size_t begin = at_++;
  while (is_name_part(peek())) ++at_;
  const std::string_view word = text_.substr(begin, at_ - begin);
  if (word == "include" || word == "use") {
    size_t open = at_;
    while (open < text_.size() && is_space(text_[open])) ++open;
    if (open < text_.size() && text_[open] == '<') return path(begin, open, word == "use");
  }
  if (word == "$") error(begin, at_, "a name is missing after \"$\"");
  put(TokenKind::name, begin);
}

void Lexer::path(size_t begin, size_t open, bool is_use) {
  const size_t close = text_.find_first_of(">\n\r", open);
  if (close == std::string_view::npos || is_line_end(text_[close])) {
    error(open, open + 1, "the path is not closed", "write > at its end");
    at_ = std::min(close, text_.size());
    return;
  }
  at_ = close + 1;
  put(is_use ? TokenKind::use_path : TokenKind::include_path, begin);
}

// Decides by the longer match: 2d is a name, 2.5 and 2e3 are numbers, 0x1F is a hexadecimal number.
bool Lexer::name_from_digit() {
  size_t end = at_;
  while (end < text_.size() && is_name_part(text_[end])) ++end;
  const std::string_view word = text_.substr(at_, end - at_);
  const bool is_hexadecimal = word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X') &&
                              word.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
  const bool is_decimal = word.find_first_not_of("0123456789") == std::string_view::npos;
  const size_t letter = word.find_first_not_of("0123456789");
  const size_t sign = at_ + letter + 1;  // position of the exponent's sign, if there is one
  const auto digit_at = [&](size_t place) { return place < text_.size() && is_digit(text_[place]); };
  const bool has_signed_exponent = letter + 1 == word.size() && sign < text_.size() &&
                                   (text_[sign] == '+' || text_[sign] == '-') && digit_at(sign + 1);
  const bool has_plain_exponent =
      digit_at(sign) && word.find_first_not_of("0123456789", letter + 1) == std::string_view::npos;
  const bool has_exponent =
      !is_decimal && (word[letter] == 'e' || word[letter] == 'E') && (has_signed_exponent || has_plain_exponent);
  if (is_decimal || has_exponent) return false;
  const size_t begin = std::exchange(at_, end);
  put(is_hexadecimal ? TokenKind::number : TokenKind::name, begin);
  return true;
}

void Lexer::number() {
  if (dialect_ == Dialect::openscad && peek() != '.' && name_from_digit()) return;
  const size_t begin = at_;
  while (is_digit(peek())) ++at_;
  if (peek() == '.') ++at_;
  while (is_digit(peek())) ++at_;
  if (peek() == 'e' || peek() == 'E') {
    const size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
    if (is_digit(peek(1 + sign))) {
      at_ += 1 + sign;
      while (is_digit(peek())) ++at_;
    }
  }
  put(TokenKind::number, begin);
  if (is_name_start(peek()) && dialect_ == Dialect::vcad) {
    size_t end = at_;
    while (end < text_.size() && is_name_part(text_[end])) ++end;
    const std::string digits(text_.substr(begin, at_ - begin));
    error(begin, std::max(end, at_ + 1), "a number runs into a name",
          "names start with a letter, and a product is written " + digits + " * x");
    at_ = std::max(end, at_ + 1);
  }
}

void Lexer::string() {
  const size_t begin = at_++;
  while (at_ < text_.size() && text_[at_] != '"') {
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
    ++at_;
  }
  if (at_ < text_.size()) {
    ++at_;
  } else {
    error(begin, begin + 1, "the string is not closed", "write \" after its last character");
    is_cut_short_ = true;
  }
  put(TokenKind::string, begin);
}

void Lexer::sign() {
  struct Pair {
    char first, second;
    TokenKind kind;
  };
  static constexpr Pair pairs[] = {{'<', '=', TokenKind::less_equal},  {'>', '=', TokenKind::greater_equal},
                                   {'=', '=', TokenKind::equal_equal}, {'!', '=', TokenKind::not_equal},
                                   {'&', '&', TokenKind::and_and},     {'|', '|', TokenKind::or_or}};
  const size_t begin = at_;
  const char next = peek(1);
  if (dialect_ == Dialect::openscad && bit_sign()) return;
  if (next == '=' || next == '&' || next == '|') {
    for (const Pair& pair : pairs) {
      if (peek() != pair.first || next != pair.second) continue;
      at_ += 2;
      return put(pair.kind, begin);
    }
  }
  const auto kind = single_sign(peek());
  if (!kind) return stray();
  ++at_;
  put(*kind, begin);
}

// Reads operators on bits.
bool Lexer::bit_sign() {
  const std::string_view rest = text_.substr(at_, 2);
  TokenKind kind = TokenKind::end;
  size_t size = 1;
  if (rest == "<<" || rest == ">>") {
    kind = rest == "<<" ? TokenKind::shift_left : TokenKind::shift_right;
    size = 2;
  } else if (rest[0] == '~') {
    kind = TokenKind::tilde;
  } else if (rest[0] == '|' && rest != "||") {
    kind = TokenKind::bar;
  } else if (rest[0] == '&' && rest != "&&") {
    kind = TokenKind::ampersand;
  } else {
    return false;
  }
  const size_t begin = at_;
  at_ += size;
  put(kind, begin);
  return true;
}

// Reports consecutive invalid bytes as one error.
void Lexer::stray() {
  const size_t begin = at_;
  const size_t size = code_point_size(text_, at_);
  if (size > 1) {
    at_ += size;
    return error(begin, at_, "a name, number or sign cannot contain \"" + std::string(text_.substr(begin, size)) + '"',
                 "such characters belong in strings and comments");
  }
  if (size == 1 && text_[at_] > ' ' && text_[at_] < '\x7F') {
    ++at_;
    const std::string hint = text_[begin] == '\'' ? "write strings between double quotes" : "";
    return error(begin, at_, std::string("there is no sign \"") + text_[begin] + '"', hint);
  }
  const auto is_binary = [&] {
    const auto byte = static_cast<unsigned char>(peek());
    return byte == 0x7F || (byte < ' ' && !is_space(peek())) || (byte >= 0x80 && code_point_size(text_, at_) == 0);
  };
  while (at_ < text_.size() && is_binary()) ++at_;
  error(begin, at_, "this is not text in UTF-8", "save the file as plain UTF-8 text");
}

void Tokens::take() {
  constexpr size_t most_taken = 256;
  last_end_ = ahead().end;
  if (++first_ < most_taken) return;
  list_.erase(list_.begin(), list_.begin() + static_cast<ptrdiff_t>(first_));
  first_ = 0;
}

StringValue read_string(const SourcePtr& source, const Token& token, Dialect dialect, Diagnostics& diagnostics) {
  return Unescaper(source, token, dialect, diagnostics).run();
}

}  // namespace ombre::lang
