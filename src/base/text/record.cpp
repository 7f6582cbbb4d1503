#include "base/text/record.h"

#include <cmath>

#include "base/text/text.h"

namespace ombre {
namespace {

bool is_in(double number, const NumberRange& range) {
  const bool is_above = range.without_least ? number > range.least : number >= range.least;
  return is_above && number <= range.most && std::isfinite(number) && (!range.is_whole || number == std::floor(number));
}

// "a whole number from 1 to 255"
std::string range_words(const NumberRange& range) {
  std::string words = range.is_whole ? "a whole number" : "a number";
  if (std::isfinite(range.least) && std::isfinite(range.most) && !range.without_least)
    return words + " from " + format_number(range.least) + " to " + format_number(range.most);
  if (std::isfinite(range.least))
    words += (range.without_least ? " above " : " of at least ") + format_number(range.least);
  if (range.without_least && std::isfinite(range.most)) words += ", up to " + format_number(range.most);
  return words;
}

}  // namespace

void RecordErrors::fail_expected(const Data& data, const std::string& expected, const Phrase& hint) const {
  const double* number = data.number();
  fail(data.where, "expected " + expected + ", not " + (number ? format_number(*number) : describe(data)), hint);
}

std::optional<double> RecordErrors::number(const Data& data, const std::string& name, const NumberRange& range) const {
  if (const double* number = data.number(); number && is_in(*number, range)) return *number;
  fail_expected(data, range_words(range) + " for \"" + name + '"');
  return std::nullopt;
}

std::optional<bool> RecordErrors::boolean(const Data& data, const std::string& name) const {
  if (const bool* value = data.boolean()) return *value;
  fail_expected(data, "true or false for \"" + name + '"');
  return std::nullopt;
}

std::optional<std::string> RecordErrors::text(const Data& data, const std::string& name) const {
  if (const std::string* text = data.string(); text && !trim(*text).empty()) return *text;
  fail_expected(data, "a text for \"" + name + '"');
  return std::nullopt;
}

std::optional<size_t> RecordErrors::choice(const Data& data, const std::string& name,
                                           const std::vector<std::string>& words) const {
  const std::string* text = data.string();
  const auto found = text ? std::ranges::find(words, *text) : words.end();
  if (found != words.end()) return static_cast<size_t>(found - words.begin());
  const std::string choices = "\"" + join(words, "\", \"") + '"';
  if (!text)
    fail_expected(data, "one of " + choices + " for \"" + name + '"');
  else {
    const std::string slip = did_you_mean(*text, words);
    fail(data.where, "there is no " + name + " \"" + *text + '"', slip.empty() ? "write one of " + choices : slip);
  }
  return std::nullopt;
}

std::optional<std::vector<double>> RecordErrors::numbers(const Data& data, const std::string& name, size_t count,
                                                         const std::string& form, const NumberRange& range) const {
  const DataList* items = data.list();
  if (!items || items->size() != count) {
    fail_expected(data, std::to_string(count) + " numbers for \"" + name + '"', "write " + form);
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (const Data& item : *items)
    if (const auto read = number(item, name, range)) numbers.push_back(*read);
  if (numbers.size() < count) return std::nullopt;
  return numbers;
}

const DataList* RecordErrors::list(const Data& data, const std::string& name) const {
  if (const DataList* items = data.list()) return items;
  fail_expected(data, "a list for \"" + name + "\", in square brackets");
  return nullptr;
}

bool RecordErrors::members(const Data& data, const std::string& what, const std::vector<std::string>& known) const {
  if (!data.members()) {
    fail_expected(data, what + " in braces", "its members are " + join(known, ", "));
    return false;
  }
  const size_t before = count();
  for (const auto& [name, value] : *data.members()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const std::string slip = did_you_mean(name, known);
    fail(value.where, std::string(what).append(" has no \"").append(name).append("\""),
         slip.empty() ? "it has " + join(known, ", ") : slip);
  }
  return count() == before;
}

}  // namespace ombre
