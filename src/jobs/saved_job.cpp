#include "jobs/saved_job.h"

#include <algorithm>

#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/all_jobs.h"
#include "options/members.h"

namespace ombre::jobs {
namespace {

constexpr const char* format = "ombre job, version 1";

void report(const Data& data, const std::string& message, const std::string& hint, Diagnostics& diagnostics) {
  diagnostics.error(Code::option, data.where, message, hint);
}

const JobKind* kind_of(const Data& data, Diagnostics& diagnostics) {
  const Data* name = data.find("kind");
  if (!name || !name->string()) {
    report(data, "the job does not say its kind", "write for example \"kind\": \"mesh\"", diagnostics);
    return nullptr;
  }
  if (const JobKind* kind = find_job(*name->string())) return kind;
  std::vector<std::string> names;
  for (const JobKind& kind : all_jobs()) names.push_back(kind.name);
  std::string hint = did_you_mean(*name->string(), names);
  if (hint.empty()) hint = "there are " + join(names, ", ");
  report(*name, "there is no kind of job \"" + *name->string() + '"', hint, diagnostics);
  return nullptr;
}

}  // namespace

std::string saved_text(const SavedJob& job, const std::string& program) {
  return print_json(
      DataMembers{{"format", format}, {"program", program}, {"kind", job.kind->name}, {"options", job.options}});
}

std::optional<SavedJob> read_saved_job(const SourcePtr& source, Diagnostics& diagnostics) {
  const auto data = parse_json(source, diagnostics);
  if (!data) return std::nullopt;
  const Data* said = data->find("format");
  if (!data->members() || !said || !said->string() || *said->string() != format) {
    report(*data, "this is no job", "a job has \"format\": \"" + std::string(format) + "\"; --save-job writes one",
           diagnostics);
    return std::nullopt;
  }
  const JobKind* kind = kind_of(*data, diagnostics);
  const Data* options = data->find("options");
  if (kind && options && options->members()) return SavedJob{kind, *options->members()};
  if (kind)
    report(*data, "the job has no options", "write for example \"options\": {\"design\": \"part.vcad\"}", diagnostics);
  return std::nullopt;
}

int run_saved_job(const SavedJob& saved, Session& session) {
  const std::shared_ptr<void> job = saved.kind->make();
  options::read_members(saved.kind->options(), job.get(), saved.options);
  return saved.kind->run(job.get(), session);
}

}  // namespace ombre::jobs
