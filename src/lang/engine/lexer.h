// Cuts a script's text into tokens.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "lang/engine/dialect.h"

namespace ombre::lang {

enum class TokenKind : uint8_t {
  end,
  name,
  number,
  string,
  include_path,
  use_path,  // include <...>, use <...>, as one token
  left_paren,
  right_paren,
  left_bracket,
  right_bracket,
  left_brace,
  right_brace,
  semicolon,
  comma,
  dot,
  colon,
  question,
  assign,
  hash,
  bar,
  ampersand,
  shift_left,
  shift_right,
  tilde,
  plus,
  minus,
  star,
  slash,
  percent,
  caret,
  bang,
  less,
  less_equal,
  greater,
  greater_equal,
  equal_equal,
  not_equal,
  and_and,
  or_or
};

struct Token {
  TokenKind kind = TokenKind::end;
  uint32_t begin = 0, end = 0;
};

// Reads a text from a place on, token by token.
class Lexer {
 public:
  Lexer(const SourcePtr& source, uint32_t begin, Dialect dialect, Diagnostics& diagnostics)
      : source_(source), text_(source->text()), dialect_(dialect), diagnostics_(diagnostics), at_(begin) {}

  Token next();  // the end, again and again, where the text ends
  // A string or comment ran to the end of the text: what then seems missing is no news.
  bool is_cut_short() const { return is_cut_short_; }

 private:
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void put(TokenKind kind, size_t begin);
  void error(size_t begin, size_t end, std::string message, Phrase hint = {});
  void skip_blank();
  void skip_comment();
  void read();
  void name();
  void path(size_t begin, size_t open, bool is_use);
  void number();
  bool name_from_digit();
  void string();
  void sign();
  bool bit_sign();
  void stray();

  const SourcePtr& source_;
  std::string_view text_;
  Dialect dialect_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  std::optional<Token> found_;
  bool is_cut_short_ = false;
};

// The tokens ahead of a reader, read when they are looked at: a file has far more than are needed at a time.
class Tokens {
 public:
  Tokens(const SourcePtr& source, uint32_t begin, Dialect dialect, Diagnostics& diagnostics)
      : lexer_(source, begin, dialect, diagnostics), last_end_(begin) {}

  Token ahead(size_t count = 0) {
    while (list_.size() - first_ <= count) list_.push_back(lexer_.next());
    return list_[first_ + count];
  }
  void take();
  uint32_t last_end() const { return last_end_; }  // of the token that was taken last
  bool is_cut_short() const { return lexer_.is_cut_short(); }

 private:
  Lexer lexer_;
  std::vector<Token> list_;
  size_t first_ = 0;  // in the list; those before it were taken
  uint32_t last_end_;
};

struct StringValue {
  std::string text;
  bool is_plain = true;  // without escapes
};

// What a string token, quotes included, says.
StringValue read_string(const SourcePtr& source, const Token& token, Dialect dialect, Diagnostics& diagnostics);

}  // namespace ombre::lang
