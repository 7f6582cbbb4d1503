// Loads results of simulations.
#include "formats/results/results.h"

#include <cmath>

#include "import/fields/result_source.h"
#include "sources/files_of_results.h"
#include "sources/loading.h"
#include "sources/result_border.h"

namespace ombre::design {
namespace {

using importing::ResultMesh;
using sources::Loading;

std::string names_of(const formats::Results& results) {
  std::string names;
  for (const formats::ResultField& field : results.fields) names += (names.empty() ? "\"" : ", \"") + field.name + '"';
  return names.empty() ? "none" : names;
}

// Returns the requested field. Null, with a diagnostic, if the request is ambiguous or the field does not exist.
const formats::ResultField* field_of(const formats::Results& results, const ResultsRequest& request,
                                     const Reader& reader) {
  const auto fail = [&](const std::string& message, const Phrase& hint) {
    reader.diagnostics.error(reader.where, message, hint);
    return nullptr;
  };
  const std::string file = "the results \"" + request.file.path + '"';
  const std::string hint = "the file has the fields " + names_of(results);
  if (request.field.empty() && results.fields.size() == 1) return &results.fields.front();
  if (request.field.empty())
    return fail("which field of " + file + " is meant is not said",
                hint + "; write " + spelled::parameter("field", "..."));
  const formats::ResultField* field = formats::find_field(results, request.field);
  if (!field) return fail(file + " have no field, or several, that \"" + request.field + "\" calls", hint);
  for (const double value : field->values)
    if (!std::isfinite(value))
      return fail("the field \"" + field->name + "\" of " + file + " has values that are not finite numbers",
                  "take another field, or save it without them");
  return field;
}

// The results of a file, with the mesh to look up places in, which is null for scattered points.
struct LoadedResults {
  std::shared_ptr<const formats::Results> points;
  std::shared_ptr<const ResultMesh> mesh;

  const formats::Results& results() const { return mesh ? mesh->results() : *points; }
};

// Reads the file and the table of values, if there is one. Null, with diagnostics, if a file is invalid.
std::optional<formats::Results> read_files(const ResultsRequest& request, const sources::ResultFiles& named,
                                           Loading& loading, const Reader& reader) {
  const auto bytes = loading.bytes(request.file);
  formats::ResultsBeside beside{{}, named.files(), static_cast<uint64_t>(request.step)};
  const auto values = request.values.path.empty() ? nullptr : loading.bytes(request.values);
  if (values) beside.values = formats::ResultsFile{request.values.path, *values};
  return formats::read_results(request.file.path, *bytes, beside, reader.diagnostics);
}

Loading::Made<LoadedResults> make_results(const ResultsRequest& request, const sources::ResultFiles& named,
                                          Loading& loading, const Reader& reader) {
  auto results = read_files(request, named, loading, reader);
  if (!results) {
    reader.diagnostics.note(reader.where, "the file is used here");
    return {};
  }
  if (request.deform != 0 && !formats::deform(*results, request.deform)) {
    reader.diagnostics.error(reader.where,
                             "the results \"" + request.file.path + "\" have no displacement of all nodes",
                             "leave deform out");
    return {};
  }
  auto loaded = std::make_shared<LoadedResults>();
  if (results->kinds.empty()) {
    size_t bytes = 150 * results->points.size();
    for (const formats::ResultField& field : results->fields) bytes += field.values.size() * sizeof(double);
    loaded->points = std::make_shared<formats::Results>(std::move(*results));
    return {std::move(loaded), bytes};
  }
  loaded->mesh = std::make_shared<ResultMesh>(std::move(*results));
  return {loaded, loaded->mesh->bytes()};
}

std::shared_ptr<const LoadedResults> results_of(const ResultsRequest& request, const sources::ResultFiles& named,
                                                Loading& loading) {
  const Hash key = sources::Key("result mesh")
                       .add(request.file.content)
                       .add(request.values.content)
                       .add(request.deform)
                       .add(request.step)
                       .hash();
  return loading.cached<LoadedResults>(
      key, request.file.path, [&](const Reader& reader) { return make_results(request, named, loading, reader); });
}

importing::OutsideRule rule_of(const ResultsRequest& request) {
  using Kind = importing::OutsideRule::Kind;
  const double within = request.within_mm.value_or(Box::inf);
  if (request.outside == "nearest") return {Kind::nearest, within, 0};
  if (request.outside == "value") return {Kind::value, within, request.otherwise};
  return {Kind::none, within, 0};
}

// Returns false, with a diagnostic, if `within` has no effect.
bool fits_rule(const ResultsRequest& request, const LoadedResults& loaded, const Reader& reader) {
  if (!request.within_mm || !loaded.mesh || request.outside == "nearest") return true;
  reader.diagnostics.error(Code::parameters, reader.where, "results has `within`, which is for outside=\"nearest\"",
                           "write " + spelled::parameter("outside", "\"nearest\"") + " as well");
  return false;
}

// Returns the source of a field. Fields with the same file and rule share a source, which finds a point's element once
// for all of them.
program::SourceField source_of(const ResultsRequest& request, const LoadedResults& loaded, Loading& loading) {
  const importing::OutsideRule rule = rule_of(request);
  const Hash key = sources::Key("results")
                       .add(request.file.content)
                       .add(request.values.content)
                       .add(request.deform)
                       .add(request.step)
                       .add(request.between.text())
                       .add(request.outside.text())
                       .add(rule.within_mm)
                       .add(rule.value)
                       .hash();
  using Made = Loading::Made<program::FieldSource>;
  return loading.cached<program::FieldSource>(key, request.file.path, [&](const Reader&) {
    const std::string& name = request.file.path;
    if (loaded.mesh) return Made{importing::make_result_source(name, loaded.mesh, rule, key), 1024};
    const bool takes_nearest = request.between == "nearest";
    return Made{importing::make_scattered_source(name, loaded.points, takes_nearest, rule, key),
                100 * loaded.points->points.size()};
  });
}

}  // namespace

std::shared_ptr<const ResultNumbers> ResultsRequest::load(Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  if (values.path.empty()) values.path = sources::numbers_beside(file.path);
  if (!values.path.empty() && (!loading.find(values) || !loading.read_content(values))) return nullptr;
  const sources::ResultFiles named = sources::result_files(file, static_cast<uint64_t>(step), loading);
  const auto loaded = results_of(*this, named, loading);
  const formats::ResultField* wanted = loaded ? field_of(loaded->results(), *this, loading.reader()) : nullptr;
  if (!wanted || !fits_rule(*this, *loaded, loading.reader())) return nullptr;
  auto numbers = std::make_shared<ResultNumbers>();
  numbers->source = source_of(*this, *loaded, loading);
  numbers->name = wanted->name;
  numbers->unit = wanted->unit;
  const auto number = static_cast<size_t>(wanted - loaded->results().fields.data());
  for (size_t n = 0; n < wanted->components; ++n)
    numbers->channels.push_back(numbers->source->channel(importing::result_channel_name(number, n)));
  return numbers;
}

}  // namespace ombre::design
