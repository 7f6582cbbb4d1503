#include "jobs/optimise/model_choice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text/json.h"
#include "formats/containers/file.h"

namespace ombre::compile {

namespace {

// Reads a study of `ombre fea`, written in place or in a file.
std::optional<fea::Study> read_fea(const Data& data, Diagnostics& diagnostics) {
  if (!data.string()) return fea::read_study(data, diagnostics);
  std::filesystem::path path(*data.string());
  if (path.is_relative() && data.where.source)
    path = std::filesystem::path(data.where.source->name()).parent_path() / path;
  const auto read = parse_json(make_source(path.string(), formats::read_file(path.string())), diagnostics);
  return read ? fea::read_study(*read, diagnostics) : std::nullopt;
}

// Returns one number for all axes, or three.
std::vector<double> along_axes(const Data& data) {
  if (const double* all = data.number()) return {*all, *all, *all};
  std::vector<double> values;
  if (const DataList* items = data.list())
    for (const Data& item : *items)
      if (const double* value = item.number()) values.push_back(*value);
  return values;
}

void read_cell(const Data& data, ModelChoice& choice, StudyMembers& members) {
  const std::vector<double> sizes = along_axes(data);
  for (size_t axis = 0; axis < 3; ++axis) {
    if (sizes.size() == 3 && sizes[axis] > 0) choice.cell[axis] = Pitch::from_mm(sizes[axis]);
    if (choice.cell[axis]) continue;
    return members.fail(data, "\"cell\" is the size of the bricks in mm", "write \"cell\": 1, or [x, y, z]");
  }
}

void read_brick_count(const Data& data, ModelChoice& choice, StudyMembers& members) {
  constexpr double most = 10'000;
  const std::vector<double> counts = along_axes(data);
  const auto is_count = [](double n) { return n >= 1 && n <= most && n == std::floor(n); };
  if (counts.size() != 3 || !std::ranges::all_of(counts, is_count))
    return members.fail(data, "\"bricks\" says into how many the design's box is cut along x, y and z",
                        "write for example \"bricks\": [20, 4, 4]");
  choice.brick_count.emplace();
  for (size_t axis = 0; axis < 3; ++axis) (*choice.brick_count)[axis] = static_cast<int64_t>(counts[axis]);
}

}  // namespace

std::optional<ModelChoice> read_model_choice(StudyMembers& members, Diagnostics& diagnostics) {
  ModelChoice choice;
  const Data *fea = members.find("fea"), *cell = members.find("cell"), *bricks = members.find("bricks");
  if (!fea || !cell == !bricks) {
    members.fail(members.data(),
                 !fea ? "\"fea\" is missing: materials, supports and loads"
                      : "a study has either \"cell\", the size of bricks in mm, or \"bricks\", their number",
                 "write for example \"fea\": \"pull.json\", \"cell\": 1");
    return std::nullopt;
  }
  if (cell)
    read_cell(*cell, choice, members);
  else
    read_brick_count(*bricks, choice, members);
  // Mean properties are the default, since draws jump where a design changes little.
  if (members.choice("assign", "mix", {"draw", "mix"}) == "mix") choice.request.assign = FeaRequest::Assign::mix;
  if (members.choice("fill", "exact", {"exact", "centre"}) == "centre") choice.request.fill = FeaRequest::Fill::centre;
  if (members.has("modulus")) choice.request.modulus = members.text("modulus", std::nullopt);
  choice.request.most_sections = static_cast<size_t>(members.number("sections", 1000, 1, 60'000));
  auto study = read_fea(*fea, diagnostics);
  if (!study || diagnostics.has_errors()) return std::nullopt;
  choice.fea = std::move(*study);
  return choice;
}

}  // namespace ombre::compile
