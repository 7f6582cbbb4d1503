#include "studio/studio.h"

#include <malloc.h>

#include <algorithm>
#include <variant>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "lang/engine/builtins.h"
#include "load/find_printer.h"
#include "load/library_folders.h"
#include "load/library_operators.h"
#include "load/load.h"
#include "load/node_data.h"
#include "load/node_registry.h"
#include "load/script_notes.h"
#include "load/turned.h"
#include "questions/build.h"
#include "questions/colour_map.h"
#include "sources/file_formats.h"
#include "studio/bundles.h"
#include "studio/data_scripts.h"
#include "studio/design_answer.h"
#include "studio/kept_jobs.h"
#include "studio/kind_request.h"
#include "studio/python_design.h"
#include "studio/scad_design.h"
#include "studio/script_edits.h"
#include "studio/views.h"
#include "studio/workspace/data_files.h"
#include "studio/workspace/echo_log.h"

namespace ombre::studio {
namespace {

constexpr double unlimited_seconds = 1e9;

DataList texts(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }

DataList describe_printers() {
  DataList list;
  for (const std::string& name : compile::printer_names()) {
    Diagnostics ignored;
    if (const auto printer = compile::find_printer(name, ignored))
      list.emplace_back(DataMembers{{"name", name}, {"title", printer->title}});
  }
  return list;
}

DataList describe_palettes() {
  DataList list;
  for (const compile::Palette& palette : compile::palettes()) {
    DataList colours;
    for (const design::Rgba& colour : palette.colours)
      colours.emplace_back(DataList{number(colour[0]), number(colour[1]), number(colour[2])});
    list.emplace_back(DataMembers{{"name", std::string(palette.name)}, {"colours", std::move(colours)}});
  }
  return list;
}

DataMembers joined(DataMembers first, const DataMembers& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

DataList describe_nodes() {
  DataList list;
  for (const auto& type : compile::node_registry().types()) list.emplace_back(compile::describe_node(*type));
  for (const compile::Operator& op : compile::operators_in(compile::library_folders()))
    list.emplace_back(compile::describe_operator(op));
  return list;
}

DataList describe_functions() {
  DataList list;
  for (const lang::Builtin& builtin : lang::builtins())
    list.emplace_back(DataMembers{{"name", builtin.name}, {"signature", builtin.signature()}});
  return list;
}

// Returns the endings of all files that designs read.
DataList read_endings() {
  DataList list;
  for (const FileFormat& format : sources::file_formats())
    if (format.is_read)
      for (const std::string_view ending : format.endings) list.emplace_back(std::string(ending));
  return list;
}

bool has_ending(const std::string& file, std::string_view ending) { return ending_of(file) == ending; }

// Returns a script with the example of a node or an operator; empty if there is none.
std::string example_script(const std::string& name) {
  if (const design::NodeType* type = compile::node_registry().find(name)) return type->example;
  for (const compile::Operator& op : compile::operators_in(compile::library_folders()))
    if (op.declaration.name == name) return "use <" + op.library + ">\n" + op.declaration.example;
  return "";
}

}  // namespace

struct Studio::Kind {
  std::string_view name;
  Handler Studio::*answer;
  bool may_take_long = false;  // it has no limit of time, but can be cancelled
};

const std::vector<Studio::Kind>& Studio::kinds() {
  static const std::vector<Kind> list{{"hello", &Studio::hello},
                                      {"list", &Studio::list},
                                      {"open", &Studio::open},
                                      {"save", &Studio::save},
                                      {"files_ending_in", &Studio::files_ending_in},
                                      {"presets", &Studio::presets},
                                      {"save_preset", &Studio::save_preset},
                                      {"delete_preset", &Studio::delete_preset},
                                      {"load", &Studio::load},
                                      {"script_graph", &Studio::of_folder<script_graph_answer>},
                                      {"edit_graph", &Studio::of_folder<edit_graph_answer>},
                                      {"render", &Studio::show<picture_answer>},
                                      {"seen_at", &Studio::show<seen_at_answer>},
                                      {"thumbnail", &Studio::show<thumbnail_answer>},
                                      {"node_picture", &Studio::node_picture},
                                      {"plan", &Studio::show<plan_answer>},
                                      {"tile", &Studio::show<tile_answer>},
                                      {"probe", &Studio::show<probe_answer>},
                                      {"volume", &Studio::show<volume_answer>},
                                      {"measure", &Studio::show<measure_answer>},
                                      {"scan", &Studio::scan},
                                      {"plane", &Studio::plane},
                                      {"voxel", &Studio::voxel},
                                      {"bundle", &Studio::of_folder<bundle_answer>},
                                      {"unbundle", &Studio::of_folder<unbundle_answer>},
                                      {"examples", &Studio::of_folder<examples_answer>},
                                      {"open_example", &Studio::of_folder<open_example_answer>},
                                      {"compare", &Studio::compare},
                                      {"estimate", &Studio::estimate},
                                      {"export", &Studio::start_export},
                                      {"run", &Studio::start_kind},
                                      {"change_export", &Studio::change_export},
                                      {"open_folder", &Studio::open_folder},
                                      {"jobs", &Studio::jobs},
                                      {"keep_draft", &Studio::keep_draft},
                                      {"drop_draft", &Studio::drop_draft},
                                      {"rename", &Studio::rename},
                                      {"duplicate", &Studio::duplicate},
                                      {"delete", &Studio::remove_file},
                                      {"make_folder", &Studio::make_folder},
                                      {"is_there", &Studio::is_there},
                                      {"upload", &Studio::upload},
                                      {"import", &Studio::import},
                                      {"download", &Studio::download},
                                      {"zip", &Studio::zip, true},
                                      {"example_picture", &Studio::of_folder<example_picture_answer>}};
  return list;
}

Studio::Studio(const std::filesystem::path& folder, StudioOptions options, sources::SourceCache& cache)
    : options_(std::move(options)),
      cache_(cache),
      workspace_(folder),
      scans_(workspace_),
      presets_(workspace_),
      state_lock_(options_.state),
      drafts_(options_.state.empty() ? options_.state : options_.state / "drafts"),
      exports_(
          [this](const DataMembers& job) {
            broadcast("job", {{"job", job}});
          },
          [this](const DataList& jobs) { keep_jobs(jobs); }, cache, options_.program),
      // Several run at once, so that short requests are answered during a long one; each uses all cores.
      queue_(std::max(4, core_count())) {
  if (state_lock_.is_held()) exports_.adopt(read_kept_jobs(options_.state));
}

Studio::~Studio() = default;

void Studio::add(const ClientPtr& client) {
  const std::lock_guard lock(mutex_);
  clients_.insert(client);
}

void Studio::remove(const ClientPtr& client) {
  queue_.cancel_all(client.get());
  const std::lock_guard lock(mutex_);
  clients_.erase(client);
}

void Studio::broadcast(const std::string& event, const DataMembers& members) {
  std::vector<ClientPtr> clients;
  {
    const std::lock_guard lock(mutex_);
    clients.assign(clients_.begin(), clients_.end());
  }
  for (const ClientPtr& client : clients) client->send(frame_of_event(event, members));
}

void Studio::take(const ClientPtr& client, const std::string& text) {
  Request request;
  try {
    request = parse_request(text);
  } catch (const RequestError& error) {
    client->send(frame_of_error(-1, error.code(), error.what()));
    return;
  }
  if (request.what == "cancel") {
    if (!request.lane.empty()) return queue_.cancel_lane(client.get(), request.lane);
    return queue_.cancel(client.get(), request.id);
  }
  const auto kind = std::ranges::find(kinds(), request.what, &Kind::name);
  if (kind == kinds().end()) {
    client->send(frame_of_error(request.id, "request", "there is no request called \"" + request.what + "\""));
    return;
  }
  const double id = request.id;
  const std::string lane = request.lane;
  const auto work = [this, client, request = std::move(request), &kind = *kind](const StopFlag& stop) {
    answer(client, request, kind, stop);
  };
  if (!queue_.add(client.get(), id, lane, work))
    client->send(frame_of_error(id, "busy", "too many requests are waiting"));
}

void Studio::answer(const ClientPtr& client, const Request& request, const Kind& kind, const StopFlag& cancelled) {
  const auto fail = [&](const std::string& code, const std::string& message) {
    client->send(frame_of_error(request.id, code, message));
  };
  has_answered_ = true;
  const StopFlag stop(&cancelled, kind.may_take_long ? unlimited_seconds : options_.most_seconds);
  try {
    if (stop.requested()) throw Cancelled();
    client->send(frame_of(request.id, (this->*kind.answer)(request, stop)));
  } catch (const RequestError& error) {
    fail(error.code(), error.what());
  } catch (const Cancelled&) {
    if (cancelled.requested()) return fail("cancelled", "the request was cancelled");
    fail("time", "this took more than " + format_rounded(options_.most_seconds) + " s and was stopped");
  } catch (const std::bad_alloc&) {
    fail("memory", "not enough memory");
  } catch (const std::exception& error) {
    fail("failed", error.what());
  }
}

// Returns memory to the system. The allocator keeps freed memory in a heap per thread, so without this the server's
// memory would grow with every edit.
void Studio::give_memory_back() {
  constexpr double seconds_between = 3;
  if (!has_answered_ || given_back_.seconds() < seconds_between) return;
  has_answered_ = false;
  given_back_ = {};
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void Studio::check_disk() {
  give_memory_back();
  for (const Workspace::Change& change : workspace_.changes())
    broadcast("changed", {{"file", change.name}, {"version", change.version}});
}

// Lists the files of the folder: designs, and data files.
DataMembers Studio::listed() const {
  DataList data;
  for (const Workspace::DataFile& file : workspace_.list_data())
    data.emplace_back(DataMembers{{"name", file.name}, {"kind", std::string(name_of(file.kind))}});
  return {{"files", texts(workspace_.list())}, {"data", std::move(data)}};
}

double Studio::idle_seconds() {
  const bool is_at_work = exports_.is_at_work();
  const std::lock_guard lock(mutex_);
  if (is_at_work || !clients_.empty()) idle_ = {};
  return idle_.seconds();
}

// A list that cannot be written does not stop jobs.
void Studio::keep_jobs(const DataList& jobs) const {
  if (!state_lock_.is_held()) return;
  try {
    write_kept_jobs(options_.state, jobs);
  } catch (const std::exception&) {
    return;
  }
}

Answer Studio::hello(const Request&, const StopFlag&) {
  Answer answer{{{"program", options_.program},
                 {"folder", workspace_.root().string()},
                 {"file", options_.first_file},
                 {"opens_folders", options_.open_folder != nullptr},
                 {"printers", describe_printers()},
                 {"job_options", describe_job_options()},
                 {"kinds", describe_kinds()},
                 {"palettes", describe_palettes()},
                 {"nodes", describe_nodes()},
                 {"functions", describe_functions()},
                 {"endings", read_endings()},
                 {"drafts", draft_names()}},
                {}};
  const DataMembers files = listed();
  answer.members.insert(answer.members.end(), files.begin(), files.end());
  return answer;
}

// Names the files that have a draft, the newest first.
DataList Studio::draft_names() const {
  DataList names;
  for (const Draft& draft : drafts_.list()) names.emplace_back(draft.file);
  return names;
}

Answer Studio::list(const Request&, const StopFlag&) { return {listed(), {}}; }

// Answers "open". For data that designs import, the answer's text is a script that shows them. A draft of a text that
// is not in its file comes with it, also if there is no file yet.
Answer Studio::open(const Request& request, const StopFlag&) {
  const std::string& name = request.text("file");
  const std::filesystem::path path = workspace_.plain_path(name);
  const DataKind kind = is_dicom_folder(path) ? DataKind::scan : data_kind(name);
  const DataMembers of_kind{{"kind", std::string(name_of(kind))}, {"version", ""}};
  if (kind != DataKind::none && kind != DataKind::table)
    return {joined({{"text", importing_design(name, path).text}}, of_kind), {}};
  const auto draft = drafts_.find(name);
  std::error_code ignored;
  const bool is_new = draft && !std::filesystem::exists(path, ignored);
  FileText file = is_new ? FileText() : workspace_.read(name);
  DataMembers members{
      {"text", std::move(file.text)}, {"version", std::move(file.version)}, {"kind", std::string(name_of(kind))}};
  if (draft)
    members.emplace_back("draft",
                         DataMembers{{"text", draft->text}, {"version", draft->version}, {"time", draft->time}});
  return {std::move(members), {}};
}

Answer Studio::save(const Request& request, const StopFlag&) {
  const std::string& name = request.text("file");
  auto saved = workspace_.save(name, request.text("text"), request.text("version"));
  if (auto* conflict = std::get_if<SaveConflict>(&saved)) {
    DataMembers members{{"saved", false}, {"gone", !conflict->disk}};
    if (conflict->disk) {
      members.emplace_back("text", conflict->disk->text);
      members.emplace_back("version", conflict->disk->version);
    }
    return {std::move(members), {}};
  }
  const std::string version = std::get<std::string>(saved);
  drafts_.remove(name);
  broadcast("changed", {{"file", name}, {"version", version}});
  return {{{"saved", true}, {"version", version}}, {}};
}

// The answer names files as in scripts, relative to the script's folder.
Answer Studio::files_ending_in(const Request& request, const StopFlag&) {
  const std::string& script = request.text("file");
  const std::filesystem::path from = std::filesystem::path(workspace_.name_of(workspace_.path(script))).parent_path();
  std::vector<std::string> endings = request.texts("endings");
  for (std::string& ending : endings) {
    if (ending.size() < 2 || ending.front() != '.')
      throw RequestError("request", "\"endings\" is a list of endings, [\".stl\"]");
    ending = to_lower(ending);
  }
  DataList files;
  for (const std::string& name : workspace_.list_ending_in(endings))
    if (name != script) files.emplace_back(std::filesystem::path(name).lexically_relative(from).generic_string());
  return {{{"files", std::move(files)}}, {}};
}

Answer Studio::presets(const Request& request, const StopFlag&) {
  return {{{"presets", presets_.list(request.text("file"))}}, {}};
}

Answer Studio::save_preset(const Request& request, const StopFlag&) {
  const Data* values = request.body.find("values");
  if (!values || !values->members())
    throw RequestError("request", "the request needs \"values\", an object: {\"width\": 3}");
  const std::string& file = request.text("file");
  return presets_answer(file, presets_.save(file, request.text("name"), *values->members(), request.flag("replace")));
}

Answer Studio::delete_preset(const Request& request, const StopFlag&) {
  const std::string& file = request.text("file");
  return presets_answer(file, presets_.remove(file, request.text("name")));
}

Answer Studio::presets_answer(const std::string& file, DataList presets) {
  broadcast("presets", {{"file", file}, {"presets", presets}});
  return {{{"presets", std::move(presets)}}, {}};
}

// Reads a design. A Python script, which may do anything, is run only when the user requests it, not while it is
// edited.
compile::LoadedPtr Studio::read(const DesignOrigin& origin, bool may_run, const SourcePtr& text,
                                const compile::LoadOptions& options, ScriptResults& results, Diagnostics& diagnostics) {
  if (has_ending(origin.file, ".scad")) return load_scad(text, options, diagnostics);
  if (!has_ending(origin.file, ".py")) {
    const auto note = [&](const SourceRange& place, auto made) { results.add(place, std::move(made)); };
    return compile::load_noting(std::string(text->text()), text->name(), options, {note, note}, diagnostics);
  }
  if (options_.command.empty()) throw RequestError("unsupported", "this studio cannot run designs in Python");
  if (!may_run) throw RequestError("unsupported", "Python scripts are shown when they are run: press Run");
  return load_python(text->name(), options_.command, options, diagnostics);
}

OpenDesignPtr Studio::load_design(const DesignOrigin& origin, bool may_run, const SourcePtr& text,
                                  compile::LoadOptions options, Diagnostics& diagnostics) {
  options.definitions = origin.definitions;
  options.cache = &cache_;
  ReadDesign design;
  design.loaded = read(origin, may_run, text, options, design.results, diagnostics);
  const auto& [x, y, z] = origin.rotate;
  if (design.loaded && (x != 0 || y != 0 || z != 0))
    design.loaded = compile::turned(design.loaded, {x, y, z}, diagnostics);
  const auto bounds = design.loaded ? compile::design_box(design.loaded->design, diagnostics) : std::nullopt;
  if (!design.loaded || !bounds || diagnostics.has_errors()) return nullptr;
  design.bounds = *bounds;
  return designs_.add(origin, std::move(design), options_.program);
}

// Loads the design of a kept job from the disk. The job was started by the user, so its script may run again.
OpenDesignPtr Studio::load_again(const DesignOrigin& origin, const StopFlag& stop) {
  compile::LoadOptions options;
  options.stop = &stop;
  Diagnostics diagnostics;
  const SourcePtr text = make_source(workspace_.path(origin.file).string(), workspace_.read(origin.file).text);
  OpenDesignPtr design = load_design(origin, true, text, options, diagnostics);
  if (!design) throw design_error(diagnostics);
  return design;
}

// Names the scans in the folder that the design reads.
DataList Studio::scans_of(const design::Design& design) const {
  std::set<std::string> names;
  for (const std::string& file : design_files(design)) {
    const std::string name = workspace_.name_of(file);
    if (!name.empty() && (data_kind(name) == DataKind::scan || is_dicom_folder(file))) names.insert(name);
  }
  return {names.begin(), names.end()};
}

// The lines of a Python script are sent while it runs, since it may take long.
Answer Studio::load(const Request& request, const StopFlag& stop) {
  DesignOrigin origin{request.text("file"), request.texts("definitions"), {}};
  if (request.body.find("rotate")) std::ranges::copy(request.numbers("rotate", 3), origin.rotate.begin());
  const SourcePtr source = make_source(workspace_.plain_path(origin.file).string(), request.text("text"));
  const bool is_python = has_ending(origin.file, ".py");
  EchoLog echo;
  compile::LoadOptions options;
  options.echo = [&](const std::string& line) {
    if (echo.add(line) && is_python)
      broadcast("said", {{"file", origin.file}, {"line", beginning_of(line, EchoLog::most_line_bytes)}});
  };
  options.stop = &stop;
  Diagnostics diagnostics;
  const OpenDesignPtr design = load_design(origin, request.flag("run"), source, options, diagnostics);
  Answer answer;
  answer.members = {{"ok", design != nullptr}, {"echo", echo.lines()}};
  if (!is_python && !has_ending(origin.file, ".json"))
    answer.members.emplace_back("variables", describe_variables(source));
  if (design) {
    answer.members = joined(answer.members, describe_design(*design, source));
    answer.members.emplace_back("scans", scans_of(design->loaded->design));
  }
  answer.members.emplace_back("diagnostics", describe(diagnostics, source));
  return answer;
}

Answer Studio::node_picture(const Request& request, const StopFlag& stop) {
  const std::string& name = request.text("name");
  const std::string script = example_script(name);
  if (script.empty()) throw RequestError("gone", "there is no example of " + name);
  compile::LoadOptions options;
  options.cache = &cache_;
  options.stop = &stop;
  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = compile::load_text(script, name + ".vcad", options, diagnostics);
  const auto bounds = loaded ? compile::design_box(loaded->design, diagnostics) : std::nullopt;
  if (!bounds || diagnostics.has_errors()) throw design_error(diagnostics);
  OpenDesign design("", {}, {loaded, *bounds, {}}, options_.program, memory_);
  return thumbnail_answer(design, request, stop);
}

Answer Studio::compare(const Request& request, const StopFlag& stop) {
  const OpenDesignPtr before = designs_.find(request.text("before"));
  return compare_answer(*before, *design_of(request), stop);
}

Answer Studio::estimate(const Request& request, const StopFlag& stop) {
  Answer answer = estimate_answer(*design_of(request), request, stop);
  std::error_code error;
  const std::filesystem::space_info disk = std::filesystem::space(workspace_.root(), error);
  if (!error) answer.members.emplace_back("free_bytes", number(disk.available));
  return answer;
}

Answer Studio::start_export(const Request& request, const StopFlag&) {
  const std::string& name = request.text("folder");
  ExportRequest job{design_of(request),
                    read_job_choices(request, {"folder", "file", "replace"}),
                    request.text("file", ""),
                    name,
                    workspace_.path(name).string(),
                    request.flag("replace")};
  return {{{"job", exports_.start(job)}}, {}};
}

Answer Studio::start_kind(const Request& request, const StopFlag&) {
  return {{{"job", exports_.start(kind_request(request, workspace_, [&] { return design_of(request); }))}}, {}};
}

void Studio::resume(int64_t job, const StopFlag& stop) {
  const auto kept = exports_.adopted(job);
  if (!kept) return exports_.resume(job);
  exports_.revive(job, revived(*kept, workspace_, [&] { return load_again(origin_of(*kept), stop); }));
}

Answer Studio::change_export(const Request& request, const StopFlag& stop) {
  const int64_t id = request.whole("job", 0, int64_t{1} << 53);
  const std::string& to = request.text("to");
  if (to == "pause")
    exports_.pause(id);
  else if (to == "resume")
    resume(id, stop);
  else if (to == "cancel")
    exports_.cancel(id);
  else
    throw RequestError("request", "\"to\" is pause, resume or cancel");
  return {};
}

Answer Studio::open_folder(const Request& request, const StopFlag&) {
  const std::filesystem::path folder = workspace_.path(request.text("folder"));
  if (!std::filesystem::is_directory(folder)) throw RequestError("gone", folder.string() + " is no folder any more");
  if (!options_.open_folder) throw RequestError("unsupported", "this studio has no display to open " + folder.string());
  if (!options_.open_folder(folder.string())) throw Error(Code::other_program, "no program opens " + folder.string());
  return {};
}

Answer Studio::jobs(const Request&, const StopFlag&) { return {{{"jobs", exports_.list()}}, {}}; }

}  // namespace ombre::studio
