#include "jobs/fea/fea_rounds.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text/text.h"
#include "jobs/fea/fea_sections.h"

namespace ombre::jobs {
namespace {

bool is_fraction(const fea::ValueField& field) { return field.name.starts_with(compile::fraction_prefix); }

double greatest_of(const std::vector<float>& values) {
  double greatest = 0;
  for (const float value : values) greatest = std::max(greatest, std::abs(static_cast<double>(value)));
  return greatest;
}

double change_of(const fea::ValueField& before, const fea::ValueField& now) {
  double change = 0;
  for (size_t n = 0; n < now.values.size(); ++n)
    change = std::max(change, std::abs(static_cast<double>(now.values[n]) - static_cast<double>(before.values[n])));
  if (is_fraction(now) || change == 0) return change;
  return change / std::max(greatest_of(before.values), greatest_of(now.values));
}

double greatest_length(const std::vector<Vec3>& vectors) {
  double greatest = 0;
  for (const Vec3& v : vectors) greatest = std::max(greatest, length(v));
  return greatest;
}

}  // namespace

RoundModel round_model_of(const fea::ModelView& model) {
  RoundModel made{model.mesh.count(), model.mesh.node_count(), model.fields, {}};
  const double all = model.mesh.total_volume_mm3();
  for (const fea::ValueField& field : model.fields) {
    if (!is_fraction(field)) continue;
    double sum = 0;
    for (size_t n = 0; n < field.values.size(); ++n) sum += field.values[n] * model.mesh.volume_mm3(n);
    made.shares.emplace_back(field.name.substr(compile::fraction_prefix.size()), sum / all);
  }
  return made;
}

std::optional<double> change_between(const RoundModel& before, const RoundModel& now) {
  if (before.elements != now.elements || before.nodes != now.nodes || before.fields.size() != now.fields.size())
    return std::nullopt;
  double change = 0;
  for (size_t n = 0; n < now.fields.size(); ++n) {
    if (before.fields[n].name != now.fields[n].name) return std::nullopt;
    change = std::max(change, change_of(before.fields[n], now.fields[n]));
  }
  return change;
}

std::string path_of_round(const std::string& path, int round) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "_" + std::to_string(round) + whole.extension().string()))
      .string();
}

void RoundHistory::add(int round, const RoundModel& model, std::optional<double> change, fea::Physics physics,
                       const compile::FeaResults& results) {
  Cells cells{{"round", std::to_string(round)},
              {"elements", std::to_string(model.elements)},
              {"change", change ? format_rounded(*change, 6) : ""}};
  for (const auto& [material, share] : model.shares)
    cells.emplace_back("share of " + material, format_rounded(share, 6));
  const auto add_number = [&](const std::string& name, double value) {
    cells.emplace_back(name, format_rounded(value, 9));
  };
  if (const auto& solution = results.solution) {
    double mises = 0;
    for (const auto& stress : solution->stress_mpa) mises = std::max(mises, fea::von_mises(stress));
    add_number("greatest displacement [mm]", greatest_length(solution->displacement_mm));
    add_number("greatest von Mises stress [MPa]", mises);
    add_number("strain energy [mJ]", solution->energy_mj);
  }
  if (const auto& conduction = results.conduction) {
    const fea::PhysicsWords& words = fea::words_of(physics);
    const std::string potential = words.potential.name + " [" + words.potential.unit + "]";
    const auto [least, most] = std::ranges::minmax_element(conduction->value);
    add_number("least " + potential, *least);
    add_number("greatest " + potential, *most);
    add_number("greatest " + words.flux.name + " [" + words.flux.unit + "]", greatest_length(conduction->flux));
  }
  rows_.push_back(std::move(cells));
}

std::string RoundHistory::text() const {
  std::vector<std::string> columns;
  for (const Cells& row : rows_)
    for (const auto& cell : row)
      if (std::ranges::find(columns, cell.first) == columns.end()) columns.push_back(cell.first);
  std::string text = join(columns, ",") + "\n";
  for (const Cells& row : rows_) {
    std::vector<std::string> cells;
    for (const std::string& column : columns) {
      const auto found = std::ranges::find(row, column, &Cells::value_type::first);
      cells.push_back(found == row.end() ? "" : found->second);
    }
    text += join(cells, ",") + "\n";
  }
  return text;
}

}  // namespace ombre::jobs
