#include "studio/kind_request.h"

#include <algorithm>
#include <filesystem>

#include "jobs/all_jobs.h"
#include "jobs/common/study_source.h"
#include "options/members.h"

namespace ombre::studio {
namespace {

// Returns true for jobs of a design or of a file. Slice stacks have their own form.
bool is_offered(const jobs::JobKind& kind) {
  const auto is_needed = [](const options::Option& option) {
    return option.is_required && (option.names == "design" || option.names == "file" || option.names == "folder");
  };
  return kind.name != "slice" && std::ranges::any_of(kind.options(), is_needed);
}

const jobs::JobKind& kind_of(const Request& request) {
  const std::string& name = request.text("kind");
  const jobs::JobKind* kind = jobs::find_job(name);
  if (!kind || !is_offered(*kind)) throw RequestError("request", "there is no kind of job called \"" + name + '"');
  return *kind;
}

const options::Option* find(const jobs::JobKind& kind, std::string_view name) {
  const auto found =
      std::ranges::find_if(kind.options(), [&](const auto& o) { return options::member_name(o.name()) == name; });
  return found == kind.options().end() ? nullptr : &*found;
}

// Replaces paths by those in the workspace, also in lists.
Data placed(const options::Option& option, const Data& value, const Workspace& workspace) {
  if (option.kind != "file") return value;
  if (const DataList* list = value.list()) {
    DataList placed_list;
    for (const Data& element : *list) placed_list.push_back(placed(option, element, workspace));
    return placed_list;
  }
  if (!value.string() || value.string()->empty() || jobs::is_study_text(*value.string())) return value;
  return workspace.path(*value.string()).string();
}

// Returns the member that says where the job writes; null if there is none.
Data* output_in(DataMembers& members) {
  const auto found = std::ranges::find(members, "output", [](const auto& member) { return member.first; });
  return found == members.end() || !found->second.string() ? nullptr : &found->second;
}

// Lets a job write into a folder of its own, from where the browser fetches the file.
void place_for_download(ExportRequest& request) {
  Data* output = output_in(request.members);
  if (!output) throw RequestError("request", "a download needs \"output\", the name of the file");
  auto folder = std::make_shared<const TemporaryFolder>();
  const std::string name = std::filesystem::path(*output->string()).filename().string();
  *output = folder->file(name.empty() ? "output" : name);
  request.holder = std::move(folder);
}

}  // namespace

DataList describe_kinds() {
  DataList list;
  for (const jobs::JobKind& kind : jobs::all_jobs()) {
    if (!is_offered(kind)) continue;
    std::vector<options::Option> shown;
    for (const options::Option& option : kind.options())
      if (option.names != "design" && option.name() != "--resume") shown.push_back(option);
    list.emplace_back(DataMembers{{"name", kind.name}, {"help", kind.help}, {"options", options::describe(shown)}});
  }
  return list;
}

ExportRequest kind_request(const Request& request, const Workspace& workspace,
                           const std::function<OpenDesignPtr()>& design) {
  const jobs::JobKind& kind = kind_of(request);
  const Data* options = request.body.find("options");
  if (!options || !options->members())
    throw RequestError("request", "the request needs \"options\", an object: {\"output\": \"part.3mf\"}");
  ExportRequest made;
  made.kind = &kind;
  made.file = request.text("file", "");
  made.shown = *options->members();
  made.replace = request.flag("replace");
  for (const auto& [name, value] : made.shown) {
    const options::Option* option = find(kind, name);
    made.members.emplace_back(name, option ? placed(*option, value, workspace) : value);
  }
  if (find(kind, "design")) {
    made.members.emplace_back("design", workspace.path(made.file).string());
    made.design = design();
  }
  if (made.replace && find(kind, "force")) made.members.emplace_back("force", true);
  if (request.flag("download")) place_for_download(made);
  const auto output = std::ranges::find(made.shown, "output", [](const auto& member) { return member.first; });
  const bool has_output = output != made.shown.end() && output->second.string() && !output->second.string()->empty();
  made.name = has_output ? *output->second.string() : kind.name + " of " + made.file;
  if (made.holder)
    made.folder = *output_in(made.members)->string();
  else
    made.folder = has_output ? workspace.path(made.name).string() : made.name;
  const std::shared_ptr<void> tried = kind.make();
  try {
    options::read_members(kind.options(), tried.get(), made.members);
  } catch (const options::WrongValue& error) {
    throw wrong_value(error);
  }
  return made;
}

}  // namespace ombre::studio
