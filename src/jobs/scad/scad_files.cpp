#include "jobs/scad/scad_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "formats/packages/mesh_formats.h"
#include "jobs/common/session.h"
#include "jobs/scad/meshed_parts.h"
#include "jobs/scad/scad_job.h"
#include "load/scad_words_design.h"

namespace ombre::jobs {
namespace {

std::vector<std::string> solid_endings() {
  std::vector<std::string> endings = formats::written_mesh_endings();
  for (const char* drawing : {".dxf", ".svg"}) endings.emplace_back(drawing);
  return endings;
}

}  // namespace

std::vector<std::string> scad_formats() {
  std::vector<std::string> endings = solid_endings();
  endings.insert(endings.begin(), {".csg", ".echo", ".ast"});
  return endings;
}

bool writes_solids(const std::string& format) {
  const std::vector<std::string> endings = solid_endings();
  return std::ranges::find(endings, "." + format) != endings.end();
}

std::optional<std::vector<std::string>> write_design(const compile::LoadedPtr& loaded, const SolidsOutput& output,
                                                     Session& session) {
  Diagnostics messages;
  auto quits = session.quit_at_once();
  auto pieces = compile::meshed_parts(loaded, messages, &session.stop);
  const solids::EvaluateOptions options{0, false, &session.stop, nullptr};
  if (pieces && output.no_overlap) pieces = compile::without_overlaps(*pieces, options);
  std::vector<compile::SolidsFile> files;
  for (const std::string& path : output.paths) {
    if (!pieces || messages.has_errors()) break;
    for (compile::SolidsFile& file : compile::solids_files(*pieces, {path, "", output.flavour}, options, messages))
      files.push_back(std::move(file));
  }
  quits.reset();
  session.events.diagnose(messages);
  if (!pieces || messages.has_errors()) return std::nullopt;
  std::vector<std::string> written;
  for (const compile::SolidsFile& file : files) {
    compile::write_solids_file(file);
    written.push_back(file.to.path);
  }
  return written;
}

namespace {

// Moves warnings to the messages of the script, and returns the other diagnostics.
Diagnostics without_warnings(const Diagnostics& found, lang::openscad::Messages& said) {
  Diagnostics others;
  for (const Diagnostic& diagnostic : found.list()) {
    if (diagnostic.severity != Severity::warning) {
      others.add(diagnostic);
      continue;
    }
    const SourceRange& where = diagnostic.where;
    const std::string text = sentence_of(diagnostic);
    using Kind = lang::openscad::Message::Kind;
    said.add({Kind::warning, text, where.source ? std::filesystem::path(where.source->name()).filename().string() : "",
              where.source ? where.source->place(where.begin).line : 0});
  }
  return others;
}

}  // namespace

std::optional<std::vector<std::string>> write_solids(const solids::TreePtr& tree, const SolidsOutput& output,
                                                     lang::openscad::Messages& said, Session& session) {
  compile::ScadRequest request;
  request.tree = tree;
  for (const std::string& path : output.paths) request.outputs.push_back({path, "", output.flavour});
  request.no_overlap = output.no_overlap;
  request.stop = &session.stop;
  Diagnostics messages;
  auto quits = session.quit_at_once();
  request.before_writing = [&] { quits.reset(); };
  const compile::ScadResult result = compile::run_scad(request, messages);
  session.events.diagnose(without_warnings(messages, said));
  if (messages.has_errors()) return std::nullopt;
  return result.files;
}

}  // namespace ombre::jobs
