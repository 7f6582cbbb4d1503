#include "studio/job_choices.h"

#include <algorithm>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::studio {
namespace {

constexpr int coarsest_level = 12;

std::string member_name(const std::string& option) { return option.substr(2); }

std::string text_of(const Data& data, const std::string& name) {
  if (data.string()) return *data.string();
  if (data.number()) return format_number(*data.number());
  if (!data.list()) throw RequestError("request", "\"" + name + "\" is a text, a number or a list of numbers");
  std::string text;
  for (const Data& element : *data.list()) text += (text.empty() ? "" : ",") + text_of(element, name);
  return text;
}

// False for what counts as not given: null, "" and a flag that is false.
bool is_given(const Data* data, const options::Option& option, const std::string& name) {
  if (!data || data->is_null()) return false;
  if (option.takes != options::Takes::nothing) return !(data->string() && data->string()->empty());
  if (!data->boolean()) throw RequestError("request", "\"" + name + "\" is true or false");
  return *data->boolean();
}

void set(JobChoices& choices, const options::Option& option, const Data& data, const std::string& name) {
  if (option.takes == options::Takes::nothing) return option.set(&choices, {});
  const std::string text = text_of(data, name);
  std::string problem;
  if (!option.choices.empty()) problem = options::problem(option.choices, text);
  if (problem.empty() && option.limits) problem = options::problem(*option.limits, text);
  if (!problem.empty()) throw RequestError("request", "\"" + name + "\": " + problem);
  option.set(&choices, {text});
}

void check_members(const Request& request, std::initializer_list<std::string_view> others) {
  std::vector<std::string> options;
  for (const options::Option& option : JobChoices::options().options()) options.push_back(member_name(option.name()));
  std::vector<std::string> known{"id", "do", "lane", "design", "level"};
  known.insert(known.end(), others.begin(), others.end());
  known.insert(known.end(), options.begin(), options.end());
  for (const auto& [name, value] : *request.body.members()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const auto similar = closest_name(name, known);
    throw RequestError("request", "there is no option \"" + name + "\" of a job" +
                                      (similar ? "; did you mean \"" + *similar + "\"?" : "") + " Options are " +
                                      join(options, ", "));
  }
}

// Options that must come with others, or without them.
void check_together(const JobChoices& choices, const options::Option& option, const std::string& name) {
  const auto is_there = [&](const std::string& other) {
    return std::ranges::find(choices.given, member_name(other), [](const auto& member) { return member.first; }) !=
           choices.given.end();
  };
  for (const std::string& needed : option.needs)
    if (!is_there(needed)) throw RequestError("request", "\"" + name + "\" needs \"" + member_name(needed) + "\"");
  for (const std::string& excluded : option.excludes)
    if (is_there(excluded))
      throw RequestError("request",
                         "\"" + name + "\" and \"" + member_name(excluded) + "\" exclude each other: leave one out");
}

DataList words(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }

DataList member_names(const std::vector<std::string>& names) {
  DataList list;
  for (const std::string& name : names) list.emplace_back(member_name(name));
  return list;
}

}  // namespace

const options::Spec<JobChoices>& JobChoices::options() {
  static const options::Spec<JobChoices> spec{options::group(&JobChoices::sampling),
                                              options::group(&JobChoices::images)};
  return spec;
}

std::string JobChoices::key() const { return std::to_string(level) + print_json_line(given); }

JobChoices read_job_choices(const Request& request, std::initializer_list<std::string_view> others) {
  check_members(request, others);
  JobChoices choices;
  try {
    for (const options::Option& option : JobChoices::options().options()) {
      const std::string name = member_name(option.name());
      const Data* data = request.body.find(name);
      if (!is_given(data, option, name)) continue;
      set(choices, option, *data, name);
      choices.given.emplace_back(name, *data);
    }
  } catch (const options::WrongValue& error) {
    throw wrong_value(error);
  }
  for (const options::Option& option : JobChoices::options().options())
    if (std::ranges::find(choices.given, member_name(option.name()), [](const auto& member) { return member.first; }) !=
        choices.given.end())
      check_together(choices, option, member_name(option.name()));
  const std::string& printer = choices.sampling.printer;
  if (printer.find('/') != std::string::npos || printer.ends_with(".json"))
    throw RequestError("name", "\"printer\" is the name of a profile that comes with Ombre");
  if (request.body.find("level")) choices.level = static_cast<int>(request.whole("level", 0, coarsest_level));
  return choices;
}

DataList describe_job_options() {
  DataList list;
  for (const options::Option& option : JobChoices::options().options()) {
    DataMembers members{{"name", member_name(option.name())},       {"help", option.help},
                        {"placeholder", option.placeholder},        {"kind", option.kind},
                        {"choices", words(option.choices)},         {"needs", member_names(option.needs)},
                        {"excludes", member_names(option.excludes)}};
    if (option.limits) {
      members.emplace_back("least", option.limits->least);
      members.emplace_back("most", option.limits->most);
    }
    list.emplace_back(std::move(members));
  }
  return list;
}

RequestError wrong_value(const options::WrongValue& error) {
  return {"request", error.message().in({Language::script, FrontEnd::studio})};
}

}  // namespace ombre::studio
