// This file uses nothing else of `base`, since each module that throws errors contains a copy.
#include "base/text/phrase.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace ombre {
namespace {

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

bool is_number(const std::string& text) {
  double number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  return status == std::errc() && end == text.data() + text.size();
}

// Writes vectors in brackets, as all languages except scripts do. The parentheses of a call stay.
std::string in_brackets(const std::string& value) {
  std::string text = value;
  std::vector<char> open;
  bool is_quoted = false;
  for (size_t n = 0; n < text.size(); ++n) {
    if (text[n] == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (text[n] == '(') {
      const bool is_call = n > 0 && (std::isalnum(static_cast<unsigned char>(text[n - 1])) != 0 || text[n - 1] == '_');
      open.push_back(is_call ? ')' : ']');
      if (!is_call) text[n] = '[';
    } else if (text[n] == ')' && !open.empty()) {
      text[n] = open.back();
      open.pop_back();
    }
  }
  return text;
}

std::string value_in(const std::string& value, Language language) {
  return language == Language::json || language == Language::openscad ? in_brackets(value) : value;
}

std::string arguments_in(const Phrase::Arguments& arguments, Language language) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : arguments)
    parts.push_back((name.empty() ? "" : name + "=") + value_in(value, language));
  return listed(parts);
}

// Returns {"type": "tile", "parameters": {...}}. Arguments without names are written as "...".
std::string node_in_json(const std::string& node, const Phrase::Arguments& arguments, bool has_inputs) {
  std::vector<std::string> members;
  for (const auto& [name, value] : arguments)
    if (!name.empty()) members.push_back('"' + name + "\": " + in_brackets(value));
  const bool are_named = members.size() == arguments.size();
  std::string text = R"({"type": ")" + node + '"';
  if (!arguments.empty()) text += ", \"parameters\": {" + (are_named ? listed(members) : "...") + '}';
  if (has_inputs) text += ", \"inputs\": [...]";
  return text + '}';
}

std::string around_in_python(const std::string& node, const std::string& arguments) {
  return "ombre." + node + "(solid" + (arguments.empty() ? "" : ", " + arguments) + ')';
}

// Returns a keyword argument of Python: numbers as they are, other values in quotes.
std::string option_in_python(const std::string& name, const std::string& value) {
  std::string keyword = name == "-o" ? "output" : name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  if (keyword == "from") keyword += '_';  // a keyword of Python
  if (value.empty()) return keyword;
  return keyword + '=' + (is_number(value) ? value : '"' + value + '"');
}

// Returns the label of a field in the studio: the option's name without dashes.
std::string option_in_studio(std::string name, const std::string& value) {
  name.erase(0, std::min(name.find_first_not_of('-'), name.size()));
  std::replace(name.begin(), name.end(), '-', ' ');
  return value.empty() ? name : name + ' ' + value;
}

}  // namespace

Wording wording_of(std::string_view file, FrontEnd front_end) {
  if (file.ends_with(".vcad") || file.ends_with(".ombre")) return {Language::script, front_end};
  if (file.ends_with(".json")) return {Language::json, front_end};
  if (file.ends_with(".scad")) return {Language::openscad, front_end};
  return {front_end == FrontEnd::python || file.ends_with(".py") ? Language::python : Language::script, front_end};
}

Phrase::Phrase(Form form, std::string name, Arguments arguments) {
  if (form != Form::text || !name.empty()) pieces_.push_back({form, std::move(name), std::move(arguments)});
}

std::string Phrase::in(const Piece& piece, const Wording& wording) {
  const auto& [form, name, arguments] = piece;
  const Language language = wording.language;
  const bool is_json = language == Language::json, is_python = language == Language::python;
  const std::string first = arguments.empty() ? "" : arguments.front().second;
  switch (form) {
    case Form::text:
      break;
    case Form::call:
      if (is_json) return node_in_json(name, arguments, false);
      return (is_python ? "ombre." : "") + name + '(' + arguments_in(arguments, language) + ')';
    case Form::around:
      if (is_json) return node_in_json(name, arguments, true);
      if (is_python) return around_in_python(name, arguments_in(arguments, language));
      return name + '(' + arguments_in(arguments, language) + ") { ... }";
    case Form::parameter:
      return is_json ? '"' + name + "\": " + in_brackets(first) : name + '=' + value_in(first, language);
    case Form::value:
      return value_in(name, language);
    case Form::option:
      if (wording.front_end == FrontEnd::python) return option_in_python(name, first);
      if (wording.front_end == FrontEnd::studio) return option_in_studio(name, first);
      return first.empty() ? name : name + ' ' + first;
    case Form::assignment:
      return name + " = " + value_in(first, language) + (is_python ? "" : ";");
    case Form::either:
      return is_json ? first : is_python ? arguments.back().second : name;
  }
  return name;
}

std::string Phrase::in(const Wording& wording) const {
  std::string text;
  for (const Piece& piece : pieces_) text += in(piece, wording);
  return text;
}

Phrase operator+(Phrase first, const Phrase& second) {
  first.pieces_.insert(first.pieces_.end(), second.pieces_.begin(), second.pieces_.end());
  return first;
}

}  // namespace ombre
