#include "jobs/fea/fea_job.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "jobs/fea/brick_fills.h"
#include "jobs/grid/grid_job.h"
#include "questions/question.h"
#include "questions/sampler.h"
#include "questions/unusable_mixtures.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::TileBox;

constexpr int64_t most_bricks_along_axis = int64_t{1} << 30;

// Returns the numbers of one grid in a slab, x fastest, then y, then z.
std::vector<float> numbers_of(const GridSlab& slab, size_t grid) {
  std::vector<float> numbers(static_cast<size_t>(slab.box.voxels()));
  for (const FieldTile& tile : slab.tiles) {
    const float* from = tile.output(grid);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
          const int64_t row = (k - slab.box.lo[2]) * slab.box.size(1) + (j - slab.box.lo[1]);
          numbers[static_cast<size_t>(row * slab.box.size(0) + i - slab.box.lo[0])] = *from;
          if (!tile.is_uniform) ++from;
        }
  }
  return numbers;
}

class ModelMaker {
 public:
  ModelMaker(const LoadedPtr& loaded, const BrickPlan& plan, const fea::Study& study, const FeaRequest& request,
             Diagnostics& diagnostics, Progress* progress, const StopFlag* stop)
      : loaded_(loaded),
        plan_(plan.bricks),
        parts_(plan.parts),
        study_(study),
        request_(request),
        diagnostics_(diagnostics),
        progress_(progress),
        stop_(stop) {}

  std::optional<fea::Model> make() {
    for (const int64_t count : plan_.request.lattice.count)
      if (count > most_bricks_along_axis)
        return fail("there are more than 2^30 bricks along an axis", "choose larger bricks");
    if (!find_cells() || (parts_ && !find_fills())) return std::nullopt;
    if (cells_.empty())
      return fail(request_.fill == FeaRequest::Fill::exact ? "no brick is inside the design by enough"
                                                           : "no brick's centre is inside the design",
                  "choose smaller bricks with " + spelled::option("--cell"));
    fea::Model model;
    const voxel::Lattice& lattice = plan_.request.lattice;
    model.bricks = fea::make_bricks(lattice.origin, lattice.voxel_mm(), std::move(cells_), {}, stop_);
    model.bricks.fills = std::move(fills_);
    model.design_mm3 = filled_count_ * model.bricks.volume_mm3();
    if (!find_fields(model) || !mend_fields(model) || !has_numbers(model.bricks)) return std::nullopt;
    auto sections = make_sections(*loaded_, study_, request_, {model.bricks.count(), drawn_, fractions_, &model.fields},
                                  diagnostics_);
    if (!sections) return std::nullopt;
    model.sections = std::move(sections->sections);
    model.section_of = std::move(sections->section_of);
    return model;
  }

 private:
  std::nullopt_t fail(const std::string& message, const Phrase& hint) {
    diagnostics_.error(Code::nothing_inside, {loaded_->source, 0, 0}, message, hint);
    return std::nullopt;
  }

  TileBox everything() const { return {{0, 0, 0}, plan_.request.lattice.count}; }

  bool find_cells() {
    GridQuery query;
    query.materials = true;
    const auto job = plan_grids(loaded_, plan_, query, everything(), diagnostics_);
    if (!job) return false;
    const auto take = [&](const GridSlab& slab) {
      const std::vector<float> ids = numbers_of(slab, 0);
      size_t n = 0;
      for (int64_t k = slab.box.lo[2]; k < slab.box.hi[2]; ++k)
        for (int64_t j = slab.box.lo[1]; j < slab.box.hi[1]; ++j)
          for (int64_t i = slab.box.lo[0]; i < slab.box.hi[0]; ++i) {
            const auto id = static_cast<MaterialId>(ids[n++]);
            if (id == 0) continue;
            cells_.push_back({static_cast<int32_t>(i), static_cast<int32_t>(j), static_cast<int32_t>(k)});
            drawn_.push_back(id);
          }
    };
    each_slab(*job, request_.threads, take, progress_, stop_);
    return true;
  }

  // Replaces bricks whose centre is inside by those that are filled, and finds materials for the new ones.
  bool find_fills() {
    auto filled = fill_bricks(design_here(), loaded_, *parts_, request_.threads, diagnostics_, stop_);
    if (!filled) return false;
    filled_count_ = filled->filled_count;
    if (request_.fill == FeaRequest::Fill::centre) return true;
    std::vector<MaterialId> drawn;
    size_t next = 0;
    for (const FilledBrick& brick : filled->bricks) {
      while (next < cells_.size() && fea::is_before(cells_[next], brick.cell)) ++next;
      const bool has_centre = next < cells_.size() && cells_[next] == brick.cell;
      drawn.push_back(has_centre ? drawn_[next] : brick.drawn);
      fills_.push_back(brick.fill);
      if (!has_centre) without_centre_.push_back({drawn.size() - 1, brick.place});
    }
    cells_.clear();
    for (const FilledBrick& brick : filled->bricks) cells_.push_back(brick.cell);
    drawn_ = std::move(drawn);
    return true;
  }

  design::Design design_here() const {
    const voxel::Lattice& lattice = plan_.request.lattice;
    design::Design design = design::for_lattice(loaded_->design, {lattice.origin, lattice.pitch});
    design.stages = plan_.stages;
    return design;
  }

  // Takes the values of bricks whose centre is outside from a place inside.
  bool mend_fields(fea::Model& model) {
    if (without_centre_.empty()) return true;
    SampleQuery query;
    query.fractions = true;
    for (size_t f = fractions_.size(); f < model.fields.size(); ++f) query.attributes.push_back(model.fields[f].name);
    const auto sampler = Sampler::build(design_here(), query, diagnostics_);
    if (!sampler) return false;
    std::vector<Vec3> places;
    for (const auto& [brick, place] : without_centre_) places.push_back(place);
    std::vector<std::vector<double>> values(sampler->columns().size(), std::vector<double>(places.size()));
    std::vector<double*> columns;
    for (auto& column : values) columns.push_back(column.data());
    sampler->sample(places, columns, request_.threads, stop_);
    for (size_t f = 0; f < model.fields.size(); ++f)
      for (size_t c = 0; c < values.size(); ++c)
        if (is_of(sampler->columns()[c], model.fields[f], f))
          for (size_t n = 0; n < places.size(); ++n)
            model.fields[f].values[without_centre_[n].first] = static_cast<float>(values[c][n]);
    return true;
  }

  bool is_of(const Sampler::Column& column, const fea::ValueField& field, size_t number) const {
    if (number < fractions_.size())
      return column.kind == Sampler::Column::Kind::fraction && column.material == fractions_[number];
    return column.kind == Sampler::Column::Kind::attribute && column.name == field.name;
  }

  bool find_fields(fea::Model& model) {
    GridQuery query;
    query.fractions = true;
    query.all_attributes = !declared_attributes(loaded_->design).empty();
    const auto job = plan_grids(loaded_, plan_, query, everything(), diagnostics_);
    if (!job) return false;
    for (const Grid& grid : job->grids) {
      const std::string unit = grid.attribute.unit == "1" ? "" : grid.attribute.unit;
      const bool is_fraction = grid.kind == GridKind::fraction;
      model.fields.push_back(
          {is_fraction ? std::string(fraction_prefix) + grid.name : grid.name, is_fraction ? "" : unit, 1, {}});
      if (is_fraction) fractions_.push_back(grid.material->id);
    }
    size_t next = 0;
    const auto take = [&](const GridSlab& slab) {
      const size_t first = next;
      for (size_t f = 0; f < model.fields.size(); ++f) {
        const std::vector<float> numbers = numbers_of(slab, f);
        for (next = first; next < model.bricks.count() && model.bricks.cells[next][2] < slab.box.hi[2]; ++next) {
          const fea::Cell& cell = model.bricks.cells[next];
          const int64_t row = (cell[2] - slab.box.lo[2]) * slab.box.size(1) + cell[1];
          model.fields[f].values.push_back(numbers[static_cast<size_t>(row * slab.box.size(0) + cell[0])]);
        }
      }
    };
    each_slab(*job, request_.threads, take, progress_, stop_);
    return true;
  }

  bool has_numbers(const fea::Bricks& bricks) {
    std::vector<Vec3> middles;
    for (size_t n = 0; n < bricks.count(); ++n) middles.push_back(bricks.centroid(n));
    for (const auto& [brick, place] : without_centre_) middles[brick] = place;
    return check_mixtures(design_here(), {middles, drawn_}, request_.threads, stop_, diagnostics_);
  }

  const LoadedPtr& loaded_;
  const Plan& plan_;
  const std::optional<Plan>& parts_;
  const fea::Study& study_;
  const FeaRequest& request_;
  Diagnostics& diagnostics_;
  Progress* progress_;
  const StopFlag* stop_;
  std::vector<fea::Cell> cells_;
  double filled_count_ = 0;                              // number of full bricks with the volume inside
  std::vector<fea::Fill> fills_;                         // fill of each cell, if parts are sampled
  std::vector<MaterialId> drawn_;                        // material of each cell
  std::vector<std::pair<size_t, Vec3>> without_centre_;  // cells whose centre is outside, with places inside
  std::vector<MaterialId> fractions_;                    // materials whose fractions are the first fields
};

fea::ValueField tensors(const std::string& name, const std::string& unit,
                        const std::vector<std::array<double, 6>>& values) {
  fea::ValueField field{name, unit, 6, {}};
  for (const auto& tensor : values)
    for (const double value : tensor) field.values.push_back(static_cast<float>(value));
  return field;
}

fea::ValueField von_mises_field(const std::string& name, const std::vector<std::array<double, 6>>& stresses) {
  fea::ValueField field{name, "MPa", 1, {}};
  for (const auto& stress : stresses) field.values.push_back(static_cast<float>(fea::von_mises(stress)));
  return field;
}

fea::ValueField vectors(const std::string& name, const std::string& unit, const std::vector<Vec3>& values) {
  fea::ValueField field{name, unit, 3, {}};
  for (const Vec3& v : values)
    for (int axis = 0; axis < 3; ++axis) field.values.push_back(static_cast<float>(v[axis]));
  return field;
}

// Joins the numbers of vectors and colours, which come as fields of their own ("fibre.x", "fibre.y", "fibre.z"), to one
// field each.
std::vector<fea::ValueField> with_vectors(const std::vector<fea::ValueField>& fields) {
  const auto count_of = [&](size_t first) -> size_t {
    for (const std::string_view parts : {"xyz", "rgba", "rgb"}) {
      size_t count = 0;
      const std::string& name = fields[first].name;
      const std::string stem = name.substr(0, name.size() - 1);
      while (stem.ends_with('.') && count < parts.size() && first + count < fields.size() &&
             fields[first + count].name == stem + parts[count])
        ++count;
      if (count == parts.size()) return count;
    }
    return 1;
  };
  std::vector<fea::ValueField> joined;
  for (size_t n = 0; n < fields.size();) {
    const size_t count = count_of(n);
    fea::ValueField field = fields[n];
    if (count > 1) {
      field.name.resize(field.name.size() - 2);
      field.components = count;
      field.values.clear();
      for (size_t e = 0; e < fields[n].values.size(); ++e)
        for (size_t c = 0; c < count; ++c) field.values.push_back(fields[n + c].values[e]);
    }
    joined.push_back(std::move(field));
    n += count;
  }
  return joined;
}

}  // namespace

std::optional<BrickPlan> plan_model(const LoadedPtr& loaded, const PlanOptions& options, FeaRequest::Fill fill,
                                    Diagnostics& diagnostics) {
  auto bricks = plan_slice(loaded, options, diagnostics);
  if (!bricks) return std::nullopt;
  if (fill == FeaRequest::Fill::centre) return BrickPlan{std::move(*bricks), std::nullopt};
  auto parts = plan_parts(loaded, options, bricks->request.lattice, diagnostics);
  if (!parts) return std::nullopt;
  return BrickPlan{std::move(*bricks), std::move(parts)};
}

std::optional<fea::Model> fea_model(const LoadedPtr& loaded, const BrickPlan& plan, const fea::Study& study,
                                    const FeaRequest& request, Diagnostics& diagnostics, Progress* progress,
                                    const StopFlag* stop) {
  return ModelMaker(loaded, plan, study, request, diagnostics, progress, stop).make();
}

std::vector<fea::ValueField> fea_element_fields(const fea::ModelView& model, fea::Physics physics,
                                                const FeaResults& results) {
  const bool is_mechanics = physics == fea::Physics::mechanics;
  const fea::PhysicsWords& words = fea::words_of(physics);
  std::vector<fea::ValueField> fields = with_vectors(model.fields);
  const std::string property_name = is_mechanics ? "modulus" : "conductivity";
  const bool is_taken = std::ranges::find(fields, property_name, &fea::ValueField::name) != fields.end();
  fea::ValueField section{"section", "", 1, {}};
  fea::ValueField property{
      is_taken ? property_name + " used" : property_name, is_mechanics ? "MPa" : words.conductivity.unit, 1, {}};
  for (size_t n = 0; n < model.mesh.count(); ++n) {
    section.values.push_back(model.section_of[n]);
    property.values.push_back(
        static_cast<float>(is_mechanics ? model.elastic(n).modulus_mpa : model.section(n).conductivity));
  }
  fields.push_back(std::move(section));
  fields.push_back(std::move(property));
  if (const auto& solution = results.solution) {
    fields.push_back(von_mises_field("von Mises stress", solution->stress_mpa));
    fields.push_back(tensors("stress", "MPa", solution->stress_mpa));
    fields.push_back(tensors("strain", "", solution->strain));
  }
  if (const auto& stresses = results.stresses) {
    fea::ValueField greatest{"greatest von Mises stress at integration points", "MPa", 1, {}};
    for (const double value : stresses->greatest_at_points_mpa) greatest.values.push_back(static_cast<float>(value));
    fields.push_back(std::move(greatest));
  }
  if (const auto& conduction = results.conduction)
    fields.push_back(vectors(words.flux.name, words.flux.unit, conduction->flux));
  return fields;
}

std::vector<fea::ValueField> fea_node_fields(fea::Physics physics, const FeaResults& results) {
  if (const auto& solution = results.solution) {
    std::vector<fea::ValueField> fields{vectors("displacement", "mm", solution->displacement_mm)};
    if (!results.stresses) return fields;
    fields.push_back(von_mises_field("nodal von Mises stress", results.stresses->at_nodes_mpa));
    fields.push_back(tensors("nodal stress", "MPa", results.stresses->at_nodes_mpa));
    return fields;
  }
  if (!results.conduction) return {};
  const fea::PhysicsWords& words = fea::words_of(physics);
  fea::ValueField field{words.potential.name, words.potential.unit, 1, {}};
  for (const double value : results.conduction->value) field.values.push_back(static_cast<float>(value));
  return {field};
}

}  // namespace ombre::compile
