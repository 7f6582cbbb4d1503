#include "jobs/saved_job.h"

#include "base/text/json.h"
#include "base/text/record.h"
#include "jobs/all_jobs.h"
#include "options/members.h"

namespace ombre::jobs {
namespace {

constexpr const char* format = "ombre job, version 1";

std::optional<const JobKind*> read_kind(const Data& data, const MemberReader& reader) {
  const std::vector<std::string> names = names_in(all_jobs());
  const auto chosen = reader.choice(data, "kind of job", names);
  return chosen ? std::optional(find_job(names[*chosen])) : std::nullopt;
}

void read_options(SavedJob& job, const Data& data, const MemberReader& reader) {
  if (const DataMembers* options = reader.named(data, "options")) job.options = *options;
}

const Record<SavedJob>& job_record() {
  static const Record<SavedJob> record =
      Record<SavedJob>(
          "a job",
          {field::value("kind", &SavedJob::kind, read_kind).required(R"(write for example "kind": "mesh")"),
           field::special("options", read_options).required(R"(write for example "options": {"design": "part.vcad"})")})
          .knows({"format", "program"});
  return record;
}

}  // namespace

Data saved_data(const SavedJob& job, const std::string& program) {
  return DataMembers{{"format", format}, {"program", program}, {"kind", job.kind->name}, {"options", job.options}};
}

std::string saved_text(const SavedJob& job, const std::string& program) { return print_json(saved_data(job, program)); }

std::optional<SavedJob> read_saved_job(const SourcePtr& source, Diagnostics& diagnostics) {
  const auto data = parse_json(source, diagnostics);
  return data ? read_saved_job(*data, MemberReader(diagnostics, Code::option)) : std::nullopt;
}

std::optional<SavedJob> read_saved_job(const Data& data, const MemberReader& reader) {
  SavedJob job;
  if (const Data* said = data.find("format"); !said || *said != Data(format))
    reader.fail(data, "this is no job", "a job has \"format\": \"" + std::string(format) + "\"; --save-job writes one");
  else if (job_record().read(data, job, reader))
    return job;
  return std::nullopt;
}

int run_saved_job(const SavedJob& saved, Session& session) {
  const std::shared_ptr<void> job = saved.kind->make();
  options::read_members(saved.kind->options(), job.get(), saved.options);
  return saved.kind->run(job.get(), session);
}

}  // namespace ombre::jobs
