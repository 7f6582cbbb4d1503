// Cuts a script's text into tokens.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostic.h"

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

struct Tokens {
  std::vector<Token> list;    // the last one is the end
  bool is_cut_short = false;  // a string or comment ran to the end of the text: what then seems missing is no news
};

Tokens lex(const SourcePtr& source, Diagnostics& diagnostics);

struct StringValue {
  std::string text;
  bool is_plain = true;  // without escapes
};

// What a string token, quotes included, says.
StringValue read_string(const SourceRange& token, Diagnostics& diagnostics);

}  // namespace ombre::lang
