#include "studio/kept_jobs.h"

#include "studio/kind_request.h"
#include "studio/workspace/state_folder.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = "jobs.json";

std::string text_in(const Data& data, std::string_view name) {
  const Data* found = data.find(name);
  return found && found->string() ? *found->string() : "";
}

}  // namespace

void write_kept_jobs(const fs::path& state, const DataList& jobs) {
  if (!state.empty()) write_state(state, list_name, DataMembers{{"jobs", jobs}});
}

DataList read_kept_jobs(const fs::path& state) {
  if (state.empty()) return {};
  const auto data = read_state(state, list_name);
  const Data* jobs = data ? data->find("jobs") : nullptr;
  return jobs && jobs->list() ? *jobs->list() : DataList();
}

DesignOrigin origin_of(const Data& job) {
  DesignOrigin origin;
  origin.file = text_in(job, "file");
  const Data *definitions = job.find("definitions"), *rotate = job.find("rotate");
  if (definitions && definitions->list())
    for (const Data& definition : *definitions->list())
      if (definition.string()) origin.definitions.push_back(*definition.string());
  if (rotate && rotate->list() && rotate->list()->size() == origin.rotate.size())
    for (size_t axis = 0; axis < origin.rotate.size(); ++axis)
      origin.rotate[axis] = rotate->list()->at(axis).number() ? *rotate->list()->at(axis).number() : 0;
  return origin;
}

ExportRequest revived(const Data& job, const Workspace& workspace, const std::function<OpenDesignPtr()>& design) {
  const Data* options = job.find("options");
  if (!options || !options->members()) throw RequestError("gone", "the job's options were not kept; start it anew");
  const std::string kind = text_in(job, "kind"), folder = text_in(job, "folder"), file = text_in(job, "file");
  Request request;
  if (kind != "slice") {
    const Data* replace = job.find("replace");
    request.body = DataMembers{{"kind", kind},
                               {"file", file},
                               {"options", *options},
                               {"replace", replace && replace->boolean() && *replace->boolean()}};
    return kind_request(request, workspace, design);
  }
  request.body = *options->members();
  // The layers that are there are the job's own, and it goes on from them.
  return {design(), read_job_choices(request, {}), file, folder, workspace.path(folder).string()};
}

}  // namespace ombre::studio
