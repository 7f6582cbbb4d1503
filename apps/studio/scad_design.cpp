#include "studio/scad_design.h"

#include <algorithm>
#include <filesystem>

#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "jobs/scad/scad_job.h"
#include "lang/openscad/run_script.h"
#include "load/load.h"
#include "load/material_map.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;
namespace openscad = lang::openscad;

// Returns the range of a message's line without leading blanks; an empty range for messages from other files.
SourceRange range_of(const SourcePtr& script, const openscad::Message& message) {
  const bool is_own = message.file.empty() || fs::path(message.file).filename() == fs::path(script->name()).filename();
  if (message.line < 1 || !is_own) return {script, 0, 0};
  const std::string_view line = script->line(message.line);
  const auto begin = static_cast<uint32_t>(line.data() - script->text().data());
  const size_t blanks = std::min(line.find_first_not_of(" \t"), line.size());
  return {script, static_cast<uint32_t>(begin + blanks), static_cast<uint32_t>(begin + line.size())};
}

void report(const openscad::Message& message, const SourcePtr& script, Diagnostics& diagnostics) {
  using Kind = openscad::Message::Kind;
  switch (message.kind) {
    case Kind::echo:  // was passed on when the script said it
      return;
    case Kind::error:
      diagnostics.error(message.code, range_of(script, message), message.text);
      return;
    case Kind::warning:
    case Kind::deprecated:
      diagnostics.warning(range_of(script, message), message.text);
      return;
    case Kind::trace:
    case Kind::note:
      diagnostics.note(range_of(script, message), message.text);
  }
}

// Returns the argument of mesh() for the job's materials of the script's names; empty if there are none.
std::string map_argument(const compile::LoadOptions& options, Diagnostics& diagnostics) {
  const auto materials = compile::load_materials(options.materials, diagnostics);
  if (!materials || options.material_map.empty()) return "";
  sources::SourceCache own;
  sources::SourceCache& cache = options.cache ? *options.cache : own;
  const auto map = compile::read_material_map(options.material_map, *materials, cache, diagnostics);
  return map ? ", material_map=" + print_json_line(Data(*map)) : "";
}

// Returns the value of mesh(materials=...): "names" if all solids have the name of a material, else "colours" if one
// has a colour, else "one", since nothing in the script says what the solids are made of.
std::string naming(const solids::Pieces& pieces, const compile::LoadOptions& options, Diagnostics& diagnostics) {
  const auto has_look = [](const solids::Piece& piece) {
    return piece.attributes.colour || !piece.attributes.material.empty();
  };
  if (std::ranges::none_of(pieces, has_look)) return "one";
  const auto materials = compile::load_materials(options.materials, diagnostics);
  const bool are_named = materials && std::ranges::all_of(pieces, [&](const auto& piece) {
                           return materials->find(piece.attributes.material) != nullptr;
                         });
  return are_named ? "names" : "colours";
}

}  // namespace

compile::LoadedPtr load_scad(const SourcePtr& script, const compile::LoadOptions& options, Diagnostics& diagnostics) {
  openscad::Options run;
  run.definitions = options.definitions;
  run.libraries = openscad::library_folders();
  run.stop = options.stop;
  if (openscad::uses_words(script, run))
    return compile::load_text(std::string(script->text()), script->name(), options, diagnostics);
  openscad::Messages messages([&](const openscad::Message& message) {
    if (options.echo && message.kind == openscad::Message::Kind::echo) options.echo(openscad::to_line(message));
  });
  const solids::TreePtr tree = openscad::run(script, run, messages);
  diagnostics.add_all(messages.details);
  for (const openscad::Message& message : messages.list()) report(message, script, diagnostics);
  if (!tree || diagnostics.has_errors()) return nullptr;

  const TemporaryFolder folder;
  const std::string mesh = folder.file("solids.3mf");
  compile::ScadRequest request;
  request.tree = tree;
  request.outputs = {{mesh}};
  request.stop = options.stop;
  const compile::ScadResult made = compile::run_scad(request, diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  compile::LoadOptions plain = options;
  plain.definitions.clear();
  plain.material_map.clear();
  const std::string text = "mesh(" + print_json_line(mesh) + ", gray, materials=\"" +
                           naming(made.pieces, options, diagnostics) + '"' + map_argument(options, diagnostics) +
                           ");\n";
  if (diagnostics.has_errors()) return nullptr;
  return compile::load_text(text, folder.file("solids.vcad"), plain, diagnostics);
}

}  // namespace ombre::studio
