#include "studio/job_choices.h"

#include <algorithm>

#include "base/text/json.h"
#include "options/members.h"

namespace ombre::studio {
namespace {

// Returns true for members of a request that are not options of its job.
bool is_of_request(const std::string& name, std::initializer_list<std::string_view> others) {
  constexpr std::string_view usual[] = {"id", "do", "lane", "design", "level"};
  return std::ranges::find(usual, name) != std::end(usual) || std::ranges::find(others, name) != others.end();
}

bool is_path(const std::string& name) { return name.find('/') != std::string::npos || name.ends_with(".json"); }

}  // namespace

const options::Spec<JobChoices>& JobChoices::options() {
  static const options::Spec<JobChoices> spec{options::group(&JobChoices::sampling),
                                              options::group(&JobChoices::images),
                                              options::group(&JobChoices::calibrations)};
  return spec;
}

std::string JobChoices::key() const { return std::to_string(level) + print_json_line(given); }

JobChoices read_job_choices(const Request& request, std::initializer_list<std::string_view> others) {
  DataMembers of_job;
  for (const auto& [name, value] : *request.body.members())
    if (!is_of_request(name, others)) of_job.emplace_back(name, value);
  JobChoices choices;
  try {
    choices.given = options::read_members(JobChoices::options().options(), &choices, of_job);
  } catch (const options::WrongValue& error) {
    throw wrong_value(error);
  }
  if (is_path(choices.sampling.printer))
    throw RequestError("name", "\"printer\" is the name of a profile that comes with Ombre");
  if (std::ranges::any_of(choices.calibrations.calibrations, is_path))
    throw RequestError("name", "\"calibration\" is the name of one that comes with Ombre");
  if (request.body.find("level")) choices.level = static_cast<int>(request.whole("level", 0, coarsest_level));
  return choices;
}

DataList describe_job_options() { return options::describe(JobChoices::options().options()); }

RequestError wrong_value(const options::WrongValue& error) {
  return {"request", error.message().in({Language::script, FrontEnd::studio})};
}

}  // namespace ombre::studio
