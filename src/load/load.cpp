#include "load/load.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "lang/engine/interpret.h"
#include "lang/openscad/definitions.h"
#include "lang/openscad/script_diagnostics.h"
#include "lang/vcad/vcad.h"
#include "load/bundle.h"
#include "load/data_folder.h"
#include "load/design_sources.h"
#include "load/library_folders.h"
#include "load/library_operators.h"
#include "load/material_map.h"
#include "load/scad_words_design.h"
#include "load/script_notes.h"
#include "nodes/all_nodes.h"

namespace ombre::compile {
namespace {

namespace openscad = lang::openscad;
using design::NodePtr;
using design::Reader;

SourcePtr read_source(const std::string& path, sources::SourceCache& cache) {
  return make_source(path, *cache.text(path));
}

bool ends_with(const std::string& path, std::string_view ending) { return to_lower(path).ends_with(ending); }

// Parses "name=value". Numbers, true, false and JSON lists keep their type; every other value is a text.
std::optional<lang::Definition> parse_definition(const std::string& text, Diagnostics& diagnostics) {
  const size_t equals = text.find('=');
  const SourcePtr source = make_source("-D", text);
  const SourceRange whole{source, 0, static_cast<uint32_t>(text.size())};
  if (equals == std::string::npos || trim(std::string_view(text).substr(0, equals)).empty()) {
    diagnostics.error(Code::option, whole, "expected a definition", "write " + spelled::option("-D", "name=value"));
    return std::nullopt;
  }
  const std::string name(trim(std::string_view(text).substr(0, equals)));
  const std::string value = text.substr(equals + 1);
  Diagnostics ignored;
  if (auto data = parse_json(make_source("-D " + name, value), ignored))
    return lang::Definition{name, std::move(*data)};
  return lang::Definition{name,
                          Data(value, {make_source("-D " + name, value), 0, static_cast<uint32_t>(value.size())})};
}

std::optional<design::MaterialTable> read_materials(const std::string& path, sources::SourceCache& cache,
                                                    Diagnostics& diagnostics) {
  const SourcePtr source = read_source(path.empty() ? data_folder() + "/materials/default.json" : path, cache);
  const size_t known = diagnostics.list().size();
  const auto data = parse_json(source, diagnostics);
  auto materials = data ? design::MaterialTable::read(*data, diagnostics) : std::nullopt;
  diagnostics.tell_code(known, Code::materials_file, {{"file", source->name()}});
  return materials;
}

// Makes the script tell the functions what it makes. What libraries make is left out.
void add_notes(const SourcePtr& source, const ScriptNotes& notes, lang::Options& run) {
  if (notes.solids)
    run.made = [&](const SourceRange& statement, std::span<const lang::Product> products) {
      if (statement.source != source) return;
      std::vector<NodePtr> solids;
      for (const lang::Product& product : products)
        solids.push_back(std::static_pointer_cast<const design::Node>(product));
      notes.solids(statement, std::move(solids));
    };
  if (!notes.value) return;
  run.computed = [&, known = std::set<std::pair<uint32_t, uint32_t>>()](const SourceRange& expression,
                                                                        const lang::Object& value) mutable {
    if (expression.source == source && known.emplace(expression.begin, expression.end).second)
      notes.value(expression, value.data());
  };
}

std::optional<design::Design> run_script(const SourcePtr& source, const LoadOptions& options, const ScriptNotes& notes,
                                         sources::SourceCache& cache, Diagnostics& diagnostics) {
  const auto materials = read_materials(options.materials, cache, diagnostics);
  lang::Options run;
  run.echo = options.echo;
  run.stop = options.stop;
  add_notes(source, notes, run);
  run.read_file = [&](const std::string& name) { return sources::read_included(name, cache); };
  run.threads = options.threads > 0 ? options.threads : core_count();
  run.needed = options.needed;
  run.libraries = library_folders();
  run.library_of = library_of;
  for (const std::string& text : options.definitions)
    if (auto definition = parse_definition(text, diagnostics)) run.definitions.push_back(std::move(*definition));
  if (!materials || diagnostics.has_errors()) return std::nullopt;
  DesignSources loader(cache, options.stop, run.threads);
  lang::VcadVocabulary vocabulary(nodes::registry(), *materials, &loader);
  auto top_level = lang::run(source, vocabulary, run, diagnostics);
  return vocabulary.finish(std::move(top_level), {source, 0, 0}, diagnostics);
}

// Returns a definition's values as `-D` gives them to an OpenSCAD script.
DataMembers script_values(const std::vector<std::string>& definitions, Diagnostics& diagnostics) {
  DataMembers values;
  for (const std::string& text : definitions)
    if (auto definition = parse_definition(text, diagnostics))
      values.emplace_back(std::move(definition->name), std::move(definition->value));
  return values;
}

std::string file_name(const SourcePtr& source) { return std::filesystem::path(source->name()).filename().string(); }

// Makes a node for the solids of a script, or of one of its parts.
NodePtr scad_node(const SourcePtr& source, const std::string& part, const DataMembers& values, const DataList& map,
                  const Reader& reader) {
  const design::NodeType& type = *nodes::registry().find("scad");
  const auto parameter = [&](const char* name) { return &type.parameters[static_cast<size_t>(type.parameter(name))]; };
  std::vector<design::NamedValue> arguments{{parameter("path"), Data(file_name(source))}};
  if (!part.empty()) arguments.push_back({parameter("part"), Data(part)});
  if (!values.empty()) arguments.push_back({parameter("variables"), Data(values)});
  if (!map.empty()) arguments.push_back({parameter("material_map"), Data(map)});
  return design::make_node(type, arguments, {}, reader);
}

// Returns the options with which a design's job runs a script. Definitions become values of its variables, as in other
// languages.
std::optional<openscad::Options> script_options(const LoadOptions& options, sources::SourceCache& cache,
                                                Diagnostics& diagnostics) {
  openscad::Options run;
  run.libraries = openscad::library_folders();
  for (std::string& folder : library_folders()) run.libraries.push_back(std::move(folder));
  run.stop = options.stop;
  run.is_preview = false;
  run.read_file = [&cache](const std::string& path) { return sources::read_included(path, cache); };
  for (const auto& [name, value] : script_values(options.definitions, diagnostics)) {
    auto definition = openscad::definition_of(name, value);
    if (!definition)
      diagnostics.error(Code::parameter_type, value.where,
                        "a script cannot get " + describe(value) + " for \"" + name + '"', {}, {{"parameter", name}});
    if (definition) run.definitions.push_back(std::move(*definition));
  }
  return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(run));
}

// Returns false, with a diagnostic, if a design that names its materials itself gets a map for those of a script.
bool check_no_map(const SourcePtr& source, const LoadOptions& options, Diagnostics& diagnostics) {
  if (options.material_map.empty()) return true;
  diagnostics.error(
      Code::option, {source, 0, 0},
      spelled::option("--material-map").text() + " is for OpenSCAD scripts without use <ombre>",
      "name materials of the materials file in the design, or write " +
          spelled::call("scad", {{"", "\"box.scad\""}, {"material_map", "[[\"PLA white\", \"white\"]]"}}));
  return false;
}

std::optional<design::Design> run_script_with_words(const SourcePtr& source, const openscad::Options& run,
                                                    const LoadOptions& options, sources::SourceCache& cache,
                                                    Diagnostics& diagnostics) {
  openscad::Messages messages;
  LoadOptions with_cache = options;
  with_cache.cache = &cache;
  WordsRun made = run_with_words(source, run, with_cache, messages, diagnostics);
  openscad::add_diagnostics(messages, source, {source, 0, 0}, diagnostics);
  return std::move(made.design);
}

std::optional<design::Design> run_scad_script(const SourcePtr& source, const LoadOptions& options,
                                              sources::SourceCache& cache, Diagnostics& diagnostics) {
  const auto run = script_options(options, cache, diagnostics);
  if (!run) return std::nullopt;
  const bool has_words = openscad::uses_words(source, *run);
  if (has_words && !check_no_map(source, options, diagnostics)) return std::nullopt;
  if (has_words) return run_script_with_words(source, *run, options, cache, diagnostics);
  const auto materials = read_materials(options.materials, cache, diagnostics);
  const DataMembers values = script_values(options.definitions, diagnostics);
  if (!materials || diagnostics.has_errors()) return std::nullopt;
  const auto map = read_material_map(options.material_map, *materials, cache, diagnostics);
  if (!map) return std::nullopt;
  DesignSources loader(cache, options.stop, options.threads > 0 ? options.threads : core_count());
  const SourceRange whole{source, 0, 0};
  const Reader reader{*materials, diagnostics, &loader, whole, "scad", ""};
  design::ScadRequest request;
  request.file.path = file_name(source);
  request.variables.values = values;
  request.material = {&materials->first()};
  for (const Data& pair : *map)
    request.material_map.push_back({*pair.list()->front().string(), {materials->find(*pair.list()->back().string())}});
  const auto solids = loader.source(request, reader);
  if (!solids) return std::nullopt;
  design::Design design{*materials, {}, {}};
  Diagnostics repeated;  // discarded: the messages of the script were reported with the first request
  const Reader again{*materials, repeated, &loader, whole, "scad", ""};
  for (const std::string& name : solids->part_names) {
    const bool is_all = solids->part_names.size() == 1;
    const NodePtr node = scad_node(source, is_all ? "" : design::part_word(name), values, *map, again);
    if (node) design.parts.push_back({name.empty() ? std::string(design::nameless_part) : name, node});
  }
  if (repeated.has_errors()) diagnostics.add_all(repeated);
  return design;
}

std::optional<design::Design> read_json_design(const SourcePtr& source, const LoadOptions& options,
                                               sources::SourceCache& cache, Diagnostics& diagnostics) {
  if (!options.materials.empty() || !options.definitions.empty()) {
    diagnostics.error(Code::option, {source, 0, 0}, "a .json design has its own materials and no variables",
                      "leave out " + spelled::option("--materials") + " and " + spelled::option("-D"));
    return std::nullopt;
  }
  const size_t known = diagnostics.list().size();
  const auto data = parse_json(source, diagnostics);
  diagnostics.tell_code(known, Code::design_file);
  if (!data) return std::nullopt;
  DesignSources loader(cache, options.stop);
  auto design = design::read_design(*data, nodes::registry(), &loader, diagnostics);
  diagnostics.tell_code(known, Code::design_file);
  return design;
}

LoadedPtr read_design(const SourcePtr& source, const LoadOptions& options, const ScriptNotes& notes,
                      sources::SourceCache& cache, Diagnostics& diagnostics) {
  const bool is_scad = ends_with(source->name(), ".scad");
  if (!is_scad && !check_no_map(source, options, diagnostics)) return nullptr;
  auto design = is_scad                              ? run_scad_script(source, options, cache, diagnostics)
                : ends_with(source->name(), ".json") ? read_json_design(source, options, cache, diagnostics)
                                                     : run_script(source, options, notes, cache, diagnostics);
  if (!design || diagnostics.has_errors() || !design::check_design(*design, diagnostics)) return nullptr;
  return std::make_shared<const Loaded>(Loaded{source->name(), source, std::move(*design)});
}

}  // namespace

std::optional<design::MaterialTable> load_materials(const std::string& path, Diagnostics& diagnostics) {
  sources::SourceCache cache;
  return read_materials(path, cache, diagnostics);
}

LoadedPtr load_design(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  if (is_bundle(path)) return load_bundle(path, options, diagnostics);
  if (ending_of(path) == ".py")  // the command line runs a script that it names; jobs and plans in files do not
    throw Error(Code::other_program,
                path + " is a Python script; run the command in Python: python3 -m ombre ... in place of ombre ...",
                {{"file", path}});
  sources::SourceCache own;
  sources::SourceCache& cache = options.cache ? *options.cache : own;
  return read_design(read_source(path, cache), options, {}, cache, diagnostics);
}

LoadedPtr load_text(std::string text, const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  return load_noting(std::move(text), path, options, {}, diagnostics);
}

LoadedPtr load_noting(std::string text, const std::string& path, const LoadOptions& options, const ScriptNotes& notes,
                      Diagnostics& diagnostics) {
  sources::SourceCache own;
  return read_design(make_source(path, std::move(text)), options, notes, options.cache ? *options.cache : own,
                     diagnostics);
}

}  // namespace ombre::compile
