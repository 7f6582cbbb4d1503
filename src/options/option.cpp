#include "options/option.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/text/text.h"

namespace ombre::options {

std::string Option::name() const {
  for (const std::string& name : split(names, ','))
    if (name.starts_with("--")) return name;
  return names;
}

std::string range_text(const Limits& limits) {
  return format_rounded(limits.least) + " to " + format_rounded(limits.most);
}

std::string problem(const Limits& limits, const std::string& text) {
  const auto number = parse_number(text);
  const bool has_form = !limits.is_whole || text.find_first_not_of("+-0123456789") == std::string::npos;
  if (number && has_form && *number >= limits.least && *number <= limits.most) return "";
  return '"' + text + (limits.is_whole ? "\" is not a whole number from " : "\" is not a number from ") +
         range_text(limits);
}

std::string problem(const std::vector<std::string>& choices, const std::string& text) {
  if (std::ranges::find(choices, text) != choices.end()) return "";
  const std::string hint = did_you_mean(text, choices);
  return "there is no \"" + text + "\"; " + (hint.empty() ? "there are " + join(choices, ", ") : hint);
}

}  // namespace ombre::options
