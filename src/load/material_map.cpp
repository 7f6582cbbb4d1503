#include "load/material_map.h"

#include <set>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr const char* option = "--material-map";

class MapReader {
 public:
  MapReader(const design::MaterialTable& materials, sources::SourceCache& cache, Diagnostics& diagnostics)
      : materials_(materials), cache_(cache), diagnostics_(diagnostics) {}

  void read(const std::string& text) {
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos) return read_file(text);
    const std::string name(trim(std::string_view(text).substr(0, equals)));
    const std::string material(trim(std::string_view(text).substr(equals + 1)));
    const SourcePtr source = make_source(option, text);
    const SourceRange whole{source, 0, static_cast<uint32_t>(text.size())};
    if (name.empty() || material.empty()) return fail(whole, "a name and a material are expected");
    add(name, material, whole);
  }

  DataList pairs() && { return std::move(pairs_); }

 private:
  void read_file(const std::string& path) {
    const SourcePtr source = make_source(path, *cache_.text(path));
    const auto data = parse_json(source, diagnostics_);
    if (!data) return;
    const DataMembers* members = data->members();
    if (!members) return fail(data->where, "an object of names and materials is expected");
    for (const auto& [name, material] : *members) {
      if (!material.string()) {
        fail(material.where, "a material is expected, not " + describe(material));
        continue;
      }
      add(name, *material.string(), material.where);
    }
  }

  void fail(const SourceRange& where, const std::string& message) {
    diagnostics_.error(Code::option, where, message,
                       "write for example " + spelled::option(option, "\"PLA white=white\"") +
                           ", or a file with {\"PLA white\": \"white\"}");
  }

  void add(const std::string& name, const std::string& material, const SourceRange& where) {
    if (!names_.insert(name).second) {
      diagnostics_.error(Code::twice, where, '"' + name + "\" gets two materials", {}, {{"name", name}});
      return;
    }
    if (materials_.find(material)) {
      pairs_.emplace_back(DataList{Data(name), Data(material)});
      return;
    }
    const std::vector<std::string> known = materials_.names();
    const std::string meant = did_you_mean(material, known);
    diagnostics_.error(Code::unknown_material, where, "there is no material \"" + material + "\" for \"" + name + '"',
                       meant.empty() ? "there are " + join(known, ", ") : meant, {{"material", material}});
  }

  const design::MaterialTable& materials_;
  sources::SourceCache& cache_;
  Diagnostics& diagnostics_;
  std::set<std::string> names_;
  DataList pairs_;
};

}  // namespace

std::optional<DataList> read_material_map(const std::vector<std::string>& texts, const design::MaterialTable& materials,
                                          sources::SourceCache& cache, Diagnostics& diagnostics) {
  const size_t errors = diagnostics.error_count();
  MapReader reader(materials, cache, diagnostics);
  for (const std::string& text : texts) reader.read(text);
  return diagnostics.error_count() == errors ? std::optional(std::move(reader).pairs()) : std::nullopt;
}

}  // namespace ombre::compile
