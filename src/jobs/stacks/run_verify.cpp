// `ombre verify` checks a slice stack by itself, and with its design.
#include "base/text/json.h"
#include "base/text/record.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/shard_ranges.h"
#include "jobs/stacks/verify_choices.h"
#include "jobs/stacks/verify_report.h"

namespace ombre::jobs {
namespace {

using compile::VerifyChoices;
using compile::VerifyRequest;

constexpr const char* verify_footer =
    "It reads all images, and compares sizes, pitch, colours and counts with job.json, and hashes with the journal.\n"
    "With the design it evaluates voxels again in double precision, with the job's own pitch, dither and seed. The\n"
    "exit code is 3 if something does not hold.\n\n"
    "Examples:\n"
    "  ombre verify part_slices\n"
    "  ombre verify part_slices --design part.vcad --report report.html\n"
    "  ombre verify part_slices --design part.vcad --all\n"
    "  ombre verify part_slices --design part.vcad --plan plan.json --seed 7\n"
    "  ombre verify part_slices --design part.vcad --all --layers 0:500     one of several processes\n";

// Returns the first layers of all shares but the first.
std::vector<int64_t> borders_of(const std::string& plan, Diagnostics& diagnostics) {
  std::vector<int64_t> borders;
  if (plan.empty()) return borders;
  const auto data = parse_json(make_source(plan, formats::read_file(plan)), diagnostics);
  if (!data) return borders;
  const MemberReader reader(diagnostics, Code::option);
  const Data* shards = data->find("shards");
  if (!shards) reader.fail(*data, "this is no plan", "ombre plan writes one");
  const auto ranges = shards ? read_shard_ranges(*shards, reader) : std::vector<stores::PieceRange>();
  for (size_t n = 1; n < ranges.size(); ++n) borders.push_back(ranges[n].begin);
  return borders;
}

std::optional<VerifyRequest> plan(const VerifyChoices& a, Session& session, Diagnostics& diagnostics) {
  VerifyRequest request{a.stack, a.layers, nullptr, {}, session.program};
  request.choice.all = a.all;
  request.choice.seed = a.seed;
  if (a.voxels) request.choice.voxels = *a.voxels;
  request.choice.borders = borders_of(a.plan, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  if (!a.design.design.empty()) {
    request.design = load_design(a.design, session, diagnostics, a.work.threads);
    if (!request.design) return std::nullopt;
  }
  return request;
}

int run(const VerifyChoices& a, const VerifyRequest& request, Session& session) {
  JobProgress progress(session.events, Counted::steps);
  const compile::CheckWork work{a.work.threads, a.work.memory_bytes, &progress, &session.stop};
  Diagnostics diagnostics;
  const auto result = compile::verify(request, work, diagnostics);
  progress.finish();
  session.events.diagnose(diagnostics);
  if (!result) return wrong_input;
  tell_verification(session.events, *result);
  if (!a.report.file.empty()) {
    exporting::write_file(a.report.file, verification_page(a.stack, *result));
    session.events.say("wrote " + a.report.file);
  }
  return result->findings().empty() ? done : check_failed;
}

int verify(const VerifyChoices& a, Session& session) { return take_report_steps<VerifyRequest>(a, session, plan, run); }

}  // namespace

JobKind verify_kind() {
  return job_kind<VerifyChoices>("verify", "Check a slice stack by itself, and with its design", verify_footer, verify);
}

}  // namespace ombre::jobs
