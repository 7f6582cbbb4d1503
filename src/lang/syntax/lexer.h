// Divides a script's text into tokens.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "lang/syntax/dialect.h"

namespace ombre::lang {

enum class TokenKind : uint8_t {
  end,
  name,
  number,
  string,
  include_path,
  use_path,  // include <...> and use <...> are single tokens
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

// Reads the tokens of a text, starting at a given position.
class Lexer {
 public:
  Lexer(const SourcePtr& source, uint32_t begin, Dialect dialect, Diagnostics& diagnostics)
      : source_(source), text_(source->text()), dialect_(dialect), diagnostics_(diagnostics), at_(begin) {}

  Token next();  // returns the end token repeatedly at the end of the text
  // True if a string or comment was not closed. Errors about missing tokens at the end of the text then follow from
  // this.
  bool is_cut_short() const { return is_cut_short_; }

 private:
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void put(TokenKind kind, size_t begin);
  void error(size_t begin, size_t end, std::string message, Phrase hint = {});
  void skip_blank();
  size_t blank_of_openscad() const;
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

// A queue of tokens ahead of the parser. Tokens are read when they are needed, since a file has far more than are
// needed at once.
class Tokens {
 public:
  Tokens(const SourcePtr& source, uint32_t begin, Dialect dialect, Diagnostics& diagnostics)
      : lexer_(source, begin, dialect, diagnostics), last_end_(begin) {}

  Token ahead(size_t count = 0) {
    while (list_.size() - first_ <= count) list_.push_back(lexer_.next());
    return list_[first_ + count];
  }
  void take();
  uint32_t last_end() const { return last_end_; }  // end of the last token that was taken
  bool is_cut_short() const { return lexer_.is_cut_short(); }

 private:
  Lexer lexer_;
  std::vector<Token> list_;
  size_t first_ = 0;  // index in list_; earlier tokens were taken
  uint32_t last_end_;
};

struct StringValue {
  std::string text;
  bool is_plain = true;  // has no escapes
};

// Returns the value of a string token; the token includes the quotes.
StringValue read_string(const SourcePtr& source, const Token& token, Dialect dialect, Diagnostics& diagnostics);

}  // namespace ombre::lang
