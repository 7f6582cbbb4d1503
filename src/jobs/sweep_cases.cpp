#include "jobs/sweep_cases.h"

#include <algorithm>

#include "base/text/text.h"
#include "jobs/common/session.h"
#include "options/members.h"
#include "stores/shard.h"

namespace ombre::jobs {
namespace {

constexpr const char* variables = "define";  // the option that sets variables

std::string option_name(const Varied& varied) { return varied.is_variable ? "-D" : "--vary"; }

// Splits a text at commas that are not within brackets or quotes.
std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values{""};
  int depth = 0;
  bool is_quoted = false;
  for (const char c : text) {
    is_quoted ^= c == '"';
    if (!is_quoted && (c == '[' || c == '(')) ++depth;
    if (!is_quoted && (c == ']' || c == ')')) --depth;
    if (c == ',' && depth <= 0 && !is_quoted)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

std::string without_brackets(const std::string& value) {
  return value.starts_with('[') && value.ends_with(']') ? value.substr(1, value.size() - 2) : value;
}

// Sets a member, in place of an earlier one of the name.
void set(DataMembers& members, const std::string& name, Data value) {
  const auto found = std::ranges::find(members, name, &DataMembers::value_type::first);
  if (found == members.end())
    members.emplace_back(name, std::move(value));
  else
    found->second = std::move(value);
}

void add_definition(DataMembers& members, const std::string& definition) {
  const auto earlier = std::ranges::find(members, variables, &DataMembers::value_type::first);
  DataList all;
  if (earlier != members.end()) all = earlier->second.list() ? *earlier->second.list() : DataList{earlier->second};
  all.emplace_back(definition);
  set(members, variables, std::move(all));
}

void check_option(const SavedJob& job, const Varied& varied) {
  const std::string name = varied.is_variable ? variables : varied.name;
  std::vector<std::string> names;
  for (const options::Option& option : job.kind->options()) names.push_back(options::member_name(option.name()));
  if (std::ranges::find(names, name) != names.end()) return;
  throw WrongArgument(spelled::option(option_name(varied), varied.name + "=...") + ": jobs of the kind " +
                      job.kind->name + " have no " + (varied.is_variable ? "variables" : "option " + varied.name) +
                      "; options are " + join(names, ", "));
}

}  // namespace

Varied parse_varied(const std::string& text, bool is_variable) {
  const size_t equals = text.find('=');
  Varied varied{std::string(trim(text.substr(0, equals))), is_variable, {}};
  if (equals != std::string::npos)
    for (const std::string& value : split_values(text.substr(equals + 1)))
      varied.values.push_back(is_variable ? std::string(trim(value)) : without_brackets(std::string(trim(value))));
  const bool is_whole = std::ranges::none_of(varied.values, [](const std::string& value) { return value.empty(); });
  if (!varied.name.empty() && !varied.values.empty() && is_whole) return varied;
  throw WrongArgument(
      spelled::option(option_name(varied), text) + " does not say values; write for example " +
      (is_variable ? spelled::option("-D", "wall=0.2,0.4,0.8") : spelled::option("--vary", "cell=1,2")));
}

SweepCases::SweepCases(SavedJob job, std::vector<Varied> varied) : job_(std::move(job)), varied_(std::move(varied)) {
  for (const Varied& one : varied_) {
    check_option(job_, one);
    const auto values = static_cast<int64_t>(one.values.size());
    if (count_ > stores::most_shards / values)
      throw WrongArgument("a sweep has at most " + format_count(stores::most_shards) + " cases; vary less at once");
    count_ *= values;
  }
}

std::vector<std::string> SweepCases::values(int64_t number) const {
  std::vector<std::string> values(varied_.size());
  for (size_t n = varied_.size(); n-- > 0;) {
    const auto count = static_cast<int64_t>(varied_[n].values.size());
    values[n] = varied_[n].values[static_cast<size_t>(number % count)];
    number /= count;
  }
  return values;
}

SavedJob SweepCases::job_of(int64_t number) const {
  SavedJob job = job_;
  const std::vector<std::string> chosen = values(number);
  for (size_t n = 0; n < chosen.size(); ++n) {
    if (varied_[n].is_variable)
      add_definition(job.options, varied_[n].name + "=" + chosen[n]);
    else
      set(job.options, varied_[n].name, chosen[n]);
  }
  return job;
}

std::string SweepCases::name_of(int64_t number) const {
  std::vector<std::string> parts;
  const std::vector<std::string> chosen = values(number);
  for (size_t n = 0; n < chosen.size(); ++n) parts.push_back(varied_[n].name + " = " + chosen[n]);
  return join(parts, ", ");
}

}  // namespace ombre::jobs
