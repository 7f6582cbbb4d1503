#include "options/members.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::options {
namespace {

std::string quoted(const std::string& name) { return '"' + name + '"'; }

std::string text_of(const Data& data, const std::string& name) {
  if (data.string()) return *data.string();
  if (data.number()) return format_number(*data.number());
  if (!data.list()) throw WrongValue(quoted(name) + " is a text, a number or a list of numbers");
  std::string text;
  for (const Data& element : *data.list()) text += (text.empty() ? "" : ",") + text_of(element, name);
  return text;
}

std::vector<std::string> texts_of(const Option& option, const Data& data, const std::string& name) {
  if (option.takes != Takes::several || !data.list()) return {text_of(data, name)};
  std::vector<std::string> texts;
  for (const Data& element : *data.list()) texts.push_back(text_of(element, name));
  return texts;
}

bool is_given(const Data& data, const Option& option, const std::string& name) {
  if (data.is_null()) return false;
  if (option.takes != Takes::nothing) return !(data.string() && data.string()->empty());
  if (!data.boolean()) throw WrongValue(quoted(name) + " is true or false");
  return *data.boolean();
}

void set(const Option& option, void* job, const Data& data, const std::string& name) {
  if (option.takes == Takes::nothing) return option.set(job, {});
  const std::vector<std::string> texts = texts_of(option, data, name);
  for (const std::string& text : texts) {
    std::string wrong;
    if (!option.choices.empty()) wrong = problem(option.choices, text);
    if (wrong.empty() && option.limits) wrong = problem(*option.limits, text);
    if (!wrong.empty()) throw WrongValue(quoted(name) + ": " + wrong);
  }
  option.set(job, texts);
}

const Data* find(const DataMembers& members, const std::string& name) {
  const auto found = std::ranges::find(members, name, [](const auto& member) { return member.first; });
  return found == members.end() ? nullptr : &found->second;
}

void check_names(const std::vector<Option>& options, const DataMembers& members) {
  std::vector<std::string> known;
  for (const Option& option : options) known.push_back(member_name(option.name()));
  for (const auto& [name, value] : members) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const auto similar = closest_name(name, known);
    throw WrongValue("there is no option " + quoted(name) + " of a job" +
                     (similar ? "; did you mean " + quoted(*similar) + "?" : "") + " Options are " + join(known, ", "));
  }
}

// Checks that options which must come with others, or without them, do so.
void check_together(const Option& option, const DataMembers& given) {
  const std::string name = member_name(option.name());
  for (const std::string& needed : option.needs)
    if (!find(given, member_name(needed))) throw WrongValue(quoted(name) + " needs " + quoted(member_name(needed)));
  for (const std::string& excluded : option.excludes)
    if (find(given, member_name(excluded)))
      throw WrongValue(quoted(name) + " and " + quoted(member_name(excluded)) + " exclude each other: leave one out");
}

DataList member_names(const std::vector<std::string>& names) {
  DataList list;
  for (const std::string& name : names) list.emplace_back(member_name(name));
  return list;
}

}  // namespace

std::string member_name(const std::string& option) { return option.starts_with("--") ? option.substr(2) : option; }

void set_member(const Option& option, void* job, const Data& data) {
  const std::string name = member_name(option.name());
  if (!is_given(data, option, name)) throw WrongValue(quoted(name) + " says nothing; leave it out");
  set(option, job, data, name);
}

DataMembers read_members(const std::vector<Option>& options, void* job, const DataMembers& members) {
  check_names(options, members);
  DataMembers given;
  for (const Option& option : options) {
    const std::string name = member_name(option.name());
    const Data* data = find(members, name);
    if (!data || !is_given(*data, option, name)) {
      if (option.is_required) throw WrongValue(quoted(name) + " is required");
      continue;
    }
    set(option, job, *data, name);
    given.emplace_back(name, *data);
  }
  for (const Option& option : options)
    if (find(given, member_name(option.name()))) check_together(option, given);
  return given;
}

DataList describe(const std::vector<Option>& options) {
  constexpr const char* takes[] = {"nothing", "one", "several"};
  DataList list;
  for (const Option& option : options) {
    DataMembers members{{"name", member_name(option.name())},
                        {"help", option.help},
                        {"placeholder", option.placeholder},
                        {"kind", option.kind},
                        {"takes", takes[static_cast<size_t>(option.takes)]},
                        {"is_required", option.is_required},
                        {"choices", DataList(option.choices.begin(), option.choices.end())},
                        {"needs", member_names(option.needs)},
                        {"excludes", member_names(option.excludes)}};
    if (option.limits) {
      members.emplace_back("least", option.limits->least);
      members.emplace_back("most", option.limits->most);
    }
    list.emplace_back(std::move(members));
  }
  return list;
}

}  // namespace ombre::options
