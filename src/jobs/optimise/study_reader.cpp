#include "jobs/optimise/study_reader.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::compile {

StudyMembers::StudyMembers(const Data& data, std::string what, const std::vector<std::string>& known,
                           Diagnostics& diagnostics)
    : data_(data), what_(std::move(what)), diagnostics_(diagnostics) {
  if (!data.members()) {
    fail(data, "expected " + what_ + " in braces, not " + describe(data), "its members are " + join(known, ", "));
    return;
  }
  for (const auto& [name, value] : *data.members()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const std::string slip = did_you_mean(name, known);
    fail(value, std::string(what_).append(" has no \"").append(name).append("\""),
         slip.empty() ? "it has " + join(known, ", ") : slip);
  }
}

void StudyMembers::fail(const Data& at, const std::string& message, const Phrase& hint) {
  diagnostics_.error(Code::study_value, at.where, message, hint);
}

double StudyMembers::number(const std::string& name, std::optional<double> missing, double least, double most) {
  const Data* const found = find(name);
  if (!found && missing) return *missing;
  if (!found) {
    fail(data_, std::string(what_).append(" needs \"").append(name).append("\", a number"));
    return least;
  }
  const double* const value = found->number();
  if (value && *value >= least && *value <= most && std::isfinite(*value)) return *value;
  std::string range;
  if (std::isfinite(least) && std::isfinite(most))
    range = " from " + format_number(least) + " to " + format_number(most);
  else if (std::isfinite(least))
    range = " of at least " + format_number(least);
  fail(*found, "\"" + name + "\" is a number" + range + ", not " + (value ? format_number(*value) : describe(*found)));
  return std::isfinite(least) ? least : 0;
}

bool StudyMembers::boolean(const std::string& name, bool missing) {
  const Data* const found = find(name);
  if (!found) return missing;
  if (const bool* value = found->boolean()) return *value;
  fail(*found, "\"" + name + "\" is true or false, not " + describe(*found));
  return missing;
}

std::string StudyMembers::text(const std::string& name, const std::optional<std::string>& missing) {
  const Data* const found = find(name);
  if (!found && missing) return *missing;
  if (found && found->string()) return *found->string();
  fail(found ? *found : data_, std::string(what_).append(" needs \"").append(name).append("\", a text in quotes"));
  return "";
}

std::string StudyMembers::choice(const std::string& name, const std::string& missing,
                                 const std::vector<std::string>& choices) {
  const std::string value = text(name, missing);
  if (std::ranges::find(choices, value) != choices.end() || (value == missing && !has(name))) return value;
  if (has(name) && find(name)->string()) {
    const std::string slip = did_you_mean(value, choices);
    fail(*find(name), "there is no " + name + " \"" + value + "\"",
         slip.empty() ? "write one of " + join(choices, ", ") : slip);
  }
  return missing;
}

std::optional<Box> StudyMembers::box(const std::string& name) {
  const Data* const found = find(name);
  if (!found) return std::nullopt;
  std::vector<double> ends;
  if (const DataList* items = found->list())
    for (const Data& item : *items)
      if (const double* value = item.number()) ends.push_back(*value);
  if (ends.size() != 6 || ends[0] > ends[3] || ends[1] > ends[4] || ends[2] > ends[5]) {
    fail(*found, "\"" + name + "\" is a box", "write [x0, y0, z0, x1, y1, z1] in mm, the lesser corner first");
    return std::nullopt;
  }
  return Box{{ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}};
}

}  // namespace ombre::compile
