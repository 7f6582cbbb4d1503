// Texts, truth values and words as parameters.
#pragma once

#include <string>
#include <string_view>

#include "design/ports/port.h"

namespace ombre::design {

// A word from a parameter's choices. Its text is part of the domain, or a literal.
class Choice {
 public:
  constexpr Choice(const char* text) : text_(text) {}  // NOLINT: implicit conversion from a literal
  std::string_view text() const { return text_; }
  bool operator==(std::string_view other) const { return text() == other; }

 private:
  const char* text_;
};

// A pair of words, such as an attribute and its overlap rule.
struct NamedWord {
  std::string name, word;
  bool operator==(const NamedWord&) const = default;
};

template <>
struct Port<bool> {
  static PortText text(const Domain&) { return {"true or false", "truth values", "bool", "boolean"}; }
  static bool read(const Data& data, const Domain& domain, bool& value, const Reader& reader);
  static Data write(const bool& value, bool for_hash);
};

template <>
struct Port<std::string> {
  static PortText text(const Domain&) { return {"text", "texts", "str", "text"}; }
  static bool read(const Data& data, const Domain& domain, std::string& value, const Reader& reader);
  static Data write(const std::string& value, bool for_hash);
  static bool is_one(const Data& data) { return data.string() != nullptr; }
};

template <>
struct Port<Choice> {
  static PortText text(const Domain&) { return {"text", "texts", "str", "choice"}; }
  static bool read(const Data& data, const Domain& domain, Choice& value, const Reader& reader);
  static Data write(const Choice& value, bool for_hash);
};

template <>
struct Port<NamedWord> {
  static PortText text(const Domain&) { return {"pair of words", "pairs of words", "tuple[str, str]"}; }
  static bool read(const Data& data, const Domain& domain, NamedWord& value, const Reader& reader);
  static Data write(const NamedWord& value, bool for_hash);
  static bool is_one(const Data& data);
};

}  // namespace ombre::design
