#include "jobs/optimise/model_choice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text/json.h"
#include "fea/solve/solvers.h"
#include "formats/containers/file.h"
#include "jobs/fea/fea_choices.h"
#include "options/members.h"

namespace ombre::compile {

namespace {

// A study of `ombre fea`, written here or in a file.
std::optional<fea::Study> read_fea(const Data& data, const MemberReader& reader) {
  Diagnostics& diagnostics = reader.diagnostics();
  if (!data.string()) return fea::read_study(data, diagnostics);
  std::filesystem::path path(*data.string());
  if (path.is_relative() && data.where.source)
    path = std::filesystem::path(data.where.source->name()).parent_path() / path;
  const auto read = parse_json(make_source(path.string(), formats::read_file(path.string())), diagnostics);
  return read ? fea::read_study(*read, diagnostics) : std::nullopt;
}

// One number for all axes, or three.
std::vector<double> along_axes(const Data& data) {
  if (const double* all = data.number()) return {*all, *all, *all};
  std::vector<double> values;
  if (const DataList* items = data.list())
    for (const Data& item : *items)
      if (const double* value = item.number()) values.push_back(*value);
  return values;
}

void read_cell(ModelChoice& choice, const Data& data, const MemberReader& reader) {
  const std::vector<double> sizes = along_axes(data);
  for (size_t axis = 0; axis < 3; ++axis) {
    if (sizes.size() == 3 && sizes[axis] > 0) choice.cell[axis] = Pitch::from_mm(sizes[axis]);
    if (choice.cell[axis]) continue;
    return reader.fail(data, "\"cell\" is the size of the bricks in mm", "write \"cell\": 1, or [x, y, z]");
  }
}

void read_brick_count(ModelChoice& choice, const Data& data, const MemberReader& reader) {
  constexpr double most = 10'000;
  const std::vector<double> counts = along_axes(data);
  const auto is_count = [](double n) { return n >= 1 && n <= most && n == std::floor(n); };
  if (counts.size() != 3 || !std::ranges::all_of(counts, is_count))
    return reader.fail(data, "\"bricks\" says into how many the design's box is cut along x, y and z",
                       "write for example \"bricks\": [20, 4, 4]");
  choice.brick_count.emplace();
  for (size_t axis = 0; axis < 3; ++axis) (*choice.brick_count)[axis] = static_cast<int64_t>(counts[axis]);
}

}  // namespace

Record<ModelChoice> model_record(Solves solves) {
  using M = ModelChoice;
  std::vector<Field<M>> members{
      field::value("fea", &M::fea, read_fea).required(R"(write for example "fea": "pull.json", "cell": 1)"),
      field::special("cell", read_cell), field::special("bricks", read_brick_count)};
  std::vector<Field<SectionOptions>> sections = options::fields_of(SectionOptions::options());
  if (solves == Solves::once)
    members.push_back(field::choice("solver", &M::solver, names_in(fea::all_solvers())));
  else
    std::erase_if(sections, [](const auto& field) { return field.name == "fill"; });
  return Record<M>("a study", members)
      .one_of({"cell", "bricks"}, R"(write for example "fea": "pull.json", "cell": 1)")
      .with(&M::sections, Record<SectionOptions>("a study", sections));
}

}  // namespace ombre::compile
