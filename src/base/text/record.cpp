#include "base/text/record.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre {
namespace {

bool is_in(double number, const NumberRange& range) {
  const bool is_above = range.without_least ? number > range.least : number >= range.least;
  return is_above && number <= range.most && std::isfinite(number) && (!range.is_whole || number == std::floor(number));
}

// Returns for example "a whole number from 1 to 255".
std::string words_of(const NumberRange& range) {
  const auto plain = [&](double end) {
    return range.is_whole ? std::to_string(static_cast<int64_t>(end)) : format_number(end);
  };
  const std::string number = range.is_whole ? "a whole number" : "a number";
  if (!std::isfinite(range.least)) return number;
  const std::string least = plain(range.least), most = std::isfinite(range.most) ? plain(range.most) : "";
  if (range.without_least) return number + " above " + least + (most.empty() ? "" : ", up to " + most);
  return number + (most.empty() ? " of at least " + least : " from " + least + " to " + most);
}

std::string quoted(const std::vector<std::string>& words) { return '"' + join(words, "\", \"") + '"'; }

}  // namespace

void MemberReader::fail_expected(const Data& data, const std::string& expected, const Phrase& hint) const {
  const double* const number = data.number();
  fail(data, "expected " + expected + ", not " + (number ? format_number(*number) : describe(data)), hint);
}

std::optional<double> MemberReader::number(const Data& data, const std::string& name, const NumberRange& range) const {
  if (const double* number = data.number(); number && is_in(*number, range)) return *number;
  fail_expected(data, words_of(range) + " for \"" + name + '"');
  return std::nullopt;
}

std::optional<bool> MemberReader::boolean(const Data& data, const std::string& name) const {
  if (const bool* value = data.boolean()) return *value;
  fail_expected(data, "true or false for \"" + name + '"');
  return std::nullopt;
}

std::optional<std::string> MemberReader::text(const Data& data, const std::string& name) const {
  if (const std::string* text = data.string(); text && !trim(*text).empty()) return *text;
  fail_expected(data, "a text for \"" + name + '"');
  return std::nullopt;
}

std::optional<size_t> MemberReader::choice(const Data& data, const std::string& name,
                                           const std::vector<std::string>& words) const {
  const std::string* const text = data.string();
  if (!text) {
    fail_expected(data, "one of " + quoted(words) + " for \"" + name + '"');
    return std::nullopt;
  }
  const auto found = std::ranges::find(words, *text);
  if (found != words.end()) return static_cast<size_t>(found - words.begin());
  const std::string slip = did_you_mean(*text, words);
  fail(data, "there is no " + name + " \"" + *text + '"', slip.empty() ? "write one of " + quoted(words) : slip);
  return std::nullopt;
}

std::optional<std::vector<double>> MemberReader::numbers(const Data& data, const std::string& name, size_t count,
                                                         const std::string& form, const NumberRange& range) const {
  const DataList* const items = data.list();
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

const DataList* MemberReader::list(const Data& data, const std::string& name) const {
  if (const DataList* items = data.list()) return items;
  fail_expected(data, "a list for \"" + name + "\", in square brackets");
  return nullptr;
}

const DataMembers* MemberReader::named(const Data& data, const std::string& what) const {
  if (const DataMembers* members = data.members()) return members;
  fail_expected(data, what + " by their names, in braces");
  return nullptr;
}

bool MemberReader::is_object(const Data& data, const std::string& what, const std::vector<std::string>& known) const {
  if (data.members()) return true;
  fail_expected(data, what + " in braces", "its members are " + join(known, ", "));
  return false;
}

void MemberReader::fail_unknown(const DataMembers::value_type& member, const std::string& what,
                                const std::string& hint) const {
  const auto& [name, value] = member;
  diagnostics_.error(Code::unknown_key, value.where, what + " has no \"" + name + '"', hint, {{"key", name}});
}

bool MemberReader::has_only(const Data& data, const std::string& what, const std::vector<std::string>& known) const {
  if (!is_object(data, what, known)) return false;
  const size_t before = error_count();
  for (const auto& member : *data.members()) {
    if (std::ranges::find(known, member.first) != known.end()) continue;
    const std::string slip = did_you_mean(member.first, known);
    fail_unknown(member, what, slip.empty() ? "it has " + join(known, ", ") : slip);
  }
  return error_count() == before;
}

bool MemberReader::has_no_slips(const Data& data, const std::string& what,
                                const std::vector<std::string>& known) const {
  if (!is_object(data, what, known)) return false;
  constexpr size_t shortest = 3;  // names of one or two letters look like slips of each other
  std::vector<std::string> missing;
  for (const std::string& name : known)
    if (name.size() >= shortest && !data.find(name)) missing.push_back(name);
  const size_t before = error_count();
  for (const auto& member : *data.members()) {
    if (std::ranges::find(known, member.first) != known.end()) continue;
    if (const std::string slip = did_you_mean(member.first, missing); !slip.empty()) fail_unknown(member, what, slip);
  }
  return error_count() == before;
}

std::optional<std::string> MemberReader::plain_name(const Data& data, const std::string& what) const {
  const auto name = text(data, "name");
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  if (!name || std::ranges::all_of(*name, is_plain)) return name;
  fail(data, what + "'s name is made of lower-case letters, digits and '-'");
  return std::nullopt;
}

void MemberReader::has_one_of(const Data& data, const std::string& what, const std::vector<std::string>& names,
                              const Phrase& hint) const {
  const auto found = std::ranges::count_if(names, [&](const std::string& name) { return data.find(name); });
  if (found == 1) return;
  if (names.size() == 1) return fail_missing(data, what, names.front(), hint);
  std::vector<std::string> choices;
  for (const std::string& name : names) choices.push_back('"' + name + '"');
  fail(data, what + " has either " + words_text(choices) + (found > 1 ? ", no two of them" : ""), hint);
}

}  // namespace ombre
