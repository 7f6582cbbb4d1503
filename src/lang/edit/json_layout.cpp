#include "lang/edit/json_layout.h"

#include "base/text/json.h"
#include "lang/edit/text_layout.h"

namespace ombre::lang {
namespace {

size_t count_of(const Data& holder) { return holder.list() ? holder.list()->size() : holder.members()->size(); }

const Data& value_of(const Data& holder, size_t index) {
  return holder.list() ? (*holder.list())[index] : (*holder.members())[index].second;
}

}  // namespace

std::string quoted(const std::string& text) { return print_json_line(Data(text)); }

// The range of a text without escapes is that of its characters (Data::where).
TextRange JsonLayout::whole(const Data& value) const {
  const size_t from = value.where.begin, to = value.where.end;
  const bool has_quotes = to > from && text_[from] == '"';
  return value.string() && !has_quotes ? TextRange{from - 1, to + 1} : TextRange{from, to};
}

TextRange JsonLayout::element(const Data& holder, size_t index) const {
  TextRange range = whole(value_of(holder, index));
  if (holder.list()) return range;
  // Only a colon and blanks stand between the quote that ends the key and the value.
  size_t quote = text_.rfind('"', range.from - 1);
  const auto is_escaped = [&](size_t at) {
    size_t slashes = 0;
    while (at > slashes && text_[at - slashes - 1] == '\\') ++slashes;
    return slashes % 2 == 1;
  };
  do quote = text_.rfind('"', quote - 1);
  while (is_escaped(quote));
  range.from = quote;
  return range;
}

Replacement JsonLayout::removed(const Data& holder, size_t index) const {
  const size_t count = count_of(holder);
  if (count == 1) return {holder.where.begin + size_t{1}, holder.where.end - size_t{1}, ""};
  if (index + 1 < count) return {element(holder, index).from, element(holder, index + 1).from, ""};
  return {element(holder, index - 1).to, element(holder, index).to, ""};
}

Replacement JsonLayout::added(const Data& holder, size_t index, const std::string& added) const {
  const size_t count = count_of(holder);
  if (count == 0) return {holder.where.begin + size_t{1}, holder.where.end - size_t{1}, added};
  if (index < count) {
    const size_t at = element(holder, index).from;
    return {at, at, added + separator(holder)};
  }
  const size_t at = element(holder, count - 1).to;
  return {at, at, separator(holder) + added};
}

Replacement JsonLayout::replaced(const Data& value, const std::string& by) const {
  const TextRange old = whole(value);
  return {old.from, old.to, by};
}

std::string JsonLayout::separator(const Data& holder) const {
  if (count_of(holder) > 1) return std::string(between(element(holder, 0).to, element(holder, 1).from));
  const TextLayout lines(text_);
  const size_t first = element(holder, 0).from;
  return lines.is_first_on_line(first) ? "," + lines.newline() + lines.indent_of(first) : ", ";
}

}  // namespace ombre::lang
