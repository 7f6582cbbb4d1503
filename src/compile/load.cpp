#include "compile/load.h"

#include <algorithm>
#include <filesystem>

#include "base/json.h"
#include "base/tasks.h"
#include "base/text.h"
#include "compile/data_folder.h"
#include "compile/design_sources.h"
#include "lang/interpret.h"
#include "lang/vocabulary/vcad.h"
#include "nodes/all_nodes.h"

namespace ombre::compile {
namespace {

SourcePtr read_source(const std::string& path, sources::SourceCache& cache) {
  return make_source(path, *cache.text(path));
}

bool ends_with(const std::string& path, std::string_view ending) { return to_lower(path).ends_with(ending); }

constexpr std::uintmax_t largest_included = 256u << 20;

std::optional<std::string> read_included(const std::string& path, sources::SourceCache& cache) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status) || std::filesystem::file_size(path, status) > largest_included)
    return std::nullopt;
  try {
    return *cache.text(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// "name=value": numbers, true, false and JSON lists as such, everything else as a text.
std::optional<lang::Definition> parse_definition(const std::string& text, Diagnostics& diagnostics) {
  const size_t equals = text.find('=');
  const SourcePtr source = make_source("-D", text);
  const SourceRange whole{source, 0, static_cast<uint32_t>(text.size())};
  if (equals == std::string::npos || trim(std::string_view(text).substr(0, equals)).empty()) {
    diagnostics.error(whole, "expected a definition", "write -D name=value");
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
  const auto data = parse_json(source, diagnostics);
  if (!data) return std::nullopt;
  return design::MaterialTable::read(*data, diagnostics);
}

std::optional<design::Design> run_script(const SourcePtr& source, const LoadOptions& options,
                                         sources::SourceCache& cache, Diagnostics& diagnostics) {
  const auto materials = read_materials(options.materials, cache, diagnostics);
  lang::Options run;
  run.echo = options.echo;
  run.stop = options.stop;
  run.read_file = [&](const std::string& name) { return read_included(name, cache); };
  run.threads = options.threads > 0 ? options.threads : core_count();
  for (const std::string& text : options.definitions)
    if (auto definition = parse_definition(text, diagnostics)) run.definitions.push_back(std::move(*definition));
  if (!materials || diagnostics.has_errors()) return std::nullopt;
  DesignSources loader(cache, options.stop);
  lang::VcadVocabulary vocabulary(nodes::registry(), *materials, &loader);
  auto top_level = lang::run(source, vocabulary, run, diagnostics);
  return vocabulary.finish(std::move(top_level), {source, 0, 0}, diagnostics);
}

std::optional<design::Design> read_json_design(const SourcePtr& source, const LoadOptions& options,
                                               sources::SourceCache& cache, Diagnostics& diagnostics) {
  if (!options.materials.empty() || !options.definitions.empty()) {
    diagnostics.error({source, 0, 0}, "a .json design has its own materials and no variables",
                      "leave out --materials and -D");
    return std::nullopt;
  }
  const auto data = parse_json(source, diagnostics);
  if (!data) return std::nullopt;
  DesignSources loader(cache, options.stop);
  return design::read_design(*data, nodes::registry(), &loader, diagnostics);
}

LoadedPtr read_design(const SourcePtr& source, const LoadOptions& options, sources::SourceCache& cache,
                      Diagnostics& diagnostics) {
  auto design = ends_with(source->name(), ".json") ? read_json_design(source, options, cache, diagnostics)
                                                   : run_script(source, options, cache, diagnostics);
  if (!design || diagnostics.has_errors() || !design::check_design(*design, diagnostics)) return nullptr;
  return std::make_shared<const Loaded>(Loaded{source->name(), source, std::move(*design)});
}

}  // namespace

std::optional<design::MaterialTable> load_materials(const std::string& path, Diagnostics& diagnostics) {
  sources::SourceCache cache;
  return read_materials(path, cache, diagnostics);
}

LoadedPtr load_design(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  sources::SourceCache own;
  sources::SourceCache& cache = options.cache ? *options.cache : own;
  return read_design(read_source(path, cache), options, cache, diagnostics);
}

LoadedPtr load_text(std::string text, const std::string& path, const LoadOptions& options, Diagnostics& diagnostics) {
  sources::SourceCache own;
  return read_design(make_source(path, std::move(text)), options, options.cache ? *options.cache : own, diagnostics);
}

}  // namespace ombre::compile
