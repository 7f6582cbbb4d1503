// Lists and objects of a JSON text: where their elements stand, and changes of them that keep the layout of the rest.
#pragma once

#include <string>
#include <string_view>

#include "base/text/data.h"
#include "lang/edit/replacement.h"

namespace ombre::lang {

struct TextRange {
  size_t from = 0, to = 0;
};

class JsonLayout {
 public:
  // Constructs a view of a text, which must outlive it. Data that its methods take were read from this text.
  explicit JsonLayout(std::string_view text) : text_(text) {}

  // Returns the range of a value, with the quotes of a text.
  TextRange whole(const Data& value) const;
  // Returns the range of an element of a list, or of a member of an object with its key.
  TextRange element(const Data& holder, size_t index) const;

  // Removes an element or a member.
  Replacement removed(const Data& holder, size_t index) const;
  // Adds an element, or a member with its key, before the one at `index`, or at the end.
  Replacement added(const Data& holder, size_t index, const std::string& element) const;
  Replacement replaced(const Data& value, const std::string& by) const;

 private:
  // Returns the text between two elements.
  std::string separator(const Data& holder) const;
  std::string_view between(size_t from, size_t to) const { return text_.substr(from, to - from); }

  std::string_view text_;
};

// Returns a text as JSON, in quotes.
std::string quoted(const std::string& text);

}  // namespace ombre::lang
