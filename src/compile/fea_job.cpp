#include "compile/fea_job.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "compile/grid_job.h"
#include "compile/question.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::TileBox;

// Poisson's ratios above this one are taken for it: an incompressible material has no bulk modulus.
constexpr double most_poissons_ratio = 0.49;
constexpr size_t most_section_count = 60'000;  // numbers of sections have 16 bits
constexpr int64_t most_along_axis = int64_t{1} << 30;

// The numbers of one grid in a slab, x fastest, then y, then z.
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

// Properties of materials, of which some are missing, perhaps.
class Properties {
 public:
  Properties(const design::MaterialTable& table, const fea::Study& study, Diagnostics& diagnostics)
      : table_(table), study_(study), diagnostics_(diagnostics) {
    for (const auto& [name, elastic] : study.materials)
      if (!table.find(name))
        diagnostics.error(study.where, "the study gives properties to \"" + name + "\", which is no material",
                          did_you_mean(name, table.names()));
  }

  // A diagnostic when there are none.
  fea::Elastic of(MaterialId id) {
    const auto known = known_.find(id);
    if (known != known_.end()) return known->second;
    const design::Material& material = *table_.find(id);
    const auto given = study_.materials.find(to_lower(material.name));
    std::optional<fea::Elastic> elastic;
    if (given != study_.materials.end())
      elastic = given->second;
    else
      elastic = fea::read_elastic(material.properties, study_.where, diagnostics_);
    if (!elastic)
      diagnostics_.error(study_.where, "there are no elastic properties of \"" + material.name + "\"",
                         "write them into the study, \"materials\": {\"" + material.name +
                             R"(": {"modulus_mpa": 2850, "poissons_ratio": 0.39}}, or into the materials file)");
    return known_[id] = compressible(elastic.value_or(fea::Elastic{1, 0, 0}), material.name);
  }

 private:
  fea::Elastic compressible(fea::Elastic elastic, const std::string& name) {
    if (elastic.poissons_ratio <= most_poissons_ratio) return elastic;
    diagnostics_.warning(study_.where, "poissons_ratio " + format_number(elastic.poissons_ratio) + " of \"" + name +
                                           "\" is taken for " + format_number(most_poissons_ratio) +
                                           ", since an incompressible material has no bulk modulus");
    elastic.poissons_ratio = most_poissons_ratio;
    return elastic;
  }

  const design::MaterialTable& table_;
  const fea::Study& study_;
  Diagnostics& diagnostics_;
  std::map<MaterialId, fea::Elastic> known_;
};

class ModelMaker {
 public:
  ModelMaker(const LoadedPtr& loaded, const Plan& plan, const fea::Study& study, const FeaRequest& request,
             Diagnostics& diagnostics, Progress* progress, const StopFlag* stop)
      : loaded_(loaded),
        plan_(plan),
        request_(request),
        diagnostics_(diagnostics),
        progress_(progress),
        stop_(stop),
        properties_(loaded->design.materials, study, diagnostics) {}

  std::optional<fea::Model> make() {
    for (const int64_t count : plan_.request.lattice.count)
      if (count > most_along_axis) return fail("there are more than 2^30 bricks along an axis", "choose larger bricks");
    if (!find_cells()) return std::nullopt;
    if (cells_.empty()) return fail("no brick's centre is inside the design", "choose smaller bricks with --cell");
    fea::Model model;
    const voxel::Lattice& lattice = plan_.request.lattice;
    model.bricks = fea::make_bricks(lattice.origin, lattice.voxel_mm(), std::move(cells_));
    if (!find_fields(model)) return std::nullopt;
    if (request_.modulus || request_.assign == FeaRequest::Assign::mix)
      mix(model);
    else
      draw(model);
    if (diagnostics_.has_errors()) return std::nullopt;
    return model;
  }

 private:
  std::nullopt_t fail(const std::string& message, const std::string& hint) {
    diagnostics_.error({loaded_->source, 0, 0}, message, hint);
    return std::nullopt;
  }

  TileBox everything() const { return {{0, 0, 0}, plan_.request.lattice.count}; }

  bool find_cells() {
    GridWishes wishes;
    wishes.materials = true;
    const auto job = plan_grids(loaded_, plan_, wishes, everything(), diagnostics_);
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

  bool find_fields(fea::Model& model) {
    GridWishes wishes;
    wishes.fractions = true;
    wishes.all_attributes = !declared_attributes(loaded_->design).empty();
    const auto job = plan_grids(loaded_, plan_, wishes, everything(), diagnostics_);
    if (!job) return false;
    for (const Grid& grid : job->grids) {
      const std::string unit = grid.attribute.unit == "1" ? "" : grid.attribute.unit;
      const bool is_fraction = grid.kind == GridKind::fraction;
      model.fields.push_back({is_fraction ? "fraction of " + grid.name : grid.name, is_fraction ? "" : unit, 1, {}});
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

  void draw(fea::Model& model) {
    std::map<MaterialId, uint16_t> numbers;
    for (const MaterialId id : drawn_) numbers.emplace(id, static_cast<uint16_t>(0));
    for (auto& [id, number] : numbers) {
      number = static_cast<uint16_t>(model.sections.size());
      model.sections.push_back({loaded_->design.materials.find(id)->name, properties_.of(id)});
    }
    for (const MaterialId id : drawn_) model.section_of.push_back(numbers[id]);
  }

  // Means of the materials by their fractions; the modulus perhaps by an attribute.
  std::vector<fea::Elastic> mean_properties(const fea::Model& model) {
    const fea::ValueField* given = nullptr;
    if (request_.modulus) {
      for (size_t f = fractions_.size(); f < model.fields.size(); ++f)
        if (model.fields[f].name == *request_.modulus) given = &model.fields[f];
      if (!given) report_unknown_attribute(loaded_->design, *request_.modulus, diagnostics_);
    }
    std::vector<fea::Elastic> means(model.bricks.count());
    for (size_t f = 0; f < fractions_.size(); ++f) {
      const fea::Elastic here = properties_.of(fractions_[f]);
      for (size_t n = 0; n < means.size(); ++n) {
        const double share = model.fields[f].values[n];
        means[n].modulus_mpa += share * here.modulus_mpa;
        means[n].poissons_ratio += share * here.poissons_ratio;
        means[n].density_t_mm3 += share * here.density_t_mm3;
      }
    }
    size_t wrong = 0;
    for (size_t n = 0; given && n < means.size(); ++n) {
      means[n].modulus_mpa = given->values[n];
      if (!(given->values[n] > 0) || !std::isfinite(given->values[n])) ++wrong;
    }
    if (wrong > 0)
      fail("the attribute \"" + *request_.modulus + "\" is no modulus above 0 in " + format_count(wrong) +
               " of the bricks",
           "let it be in MPa, for example attribute(\"" + *request_.modulus + "\", \"1 + z\", unit=\"MPa\")");
    return means;
  }

  // Bricks of about the same modulus become a section, whose properties are their means.
  void mix(fea::Model& model) {
    const std::vector<fea::Elastic> means = mean_properties(model);
    if (diagnostics_.has_errors()) return;
    const auto [least, most] = std::ranges::minmax_element(means, {}, &fea::Elastic::modulus_mpa);
    const double low = std::log(least->modulus_mpa), span = std::log(most->modulus_mpa) - low;
    const size_t bins = std::clamp<size_t>(request_.most_sections, 1, most_section_count);
    const auto bin_of = [&](const fea::Elastic& elastic) {
      if (!(span > 0)) return size_t{0};
      const double at = (std::log(elastic.modulus_mpa) - low) / span * static_cast<double>(bins);
      return std::min(static_cast<size_t>(std::max(at, 0.0)), bins - 1);
    };
    std::vector<fea::Elastic> sums(bins);
    std::vector<size_t> counts(bins), numbers(bins);
    for (const fea::Elastic& elastic : means) {
      const size_t bin = bin_of(elastic);
      ++counts[bin];
      sums[bin].modulus_mpa += elastic.modulus_mpa;
      sums[bin].poissons_ratio += elastic.poissons_ratio;
      sums[bin].density_t_mm3 += elastic.density_t_mm3;
    }
    for (size_t bin = 0; bin < bins; ++bin) {
      if (counts[bin] == 0) continue;
      const auto count = static_cast<double>(counts[bin]);
      numbers[bin] = model.sections.size();
      model.sections.push_back(
          {"mix_" + std::to_string(numbers[bin] + 1),
           {sums[bin].modulus_mpa / count, sums[bin].poissons_ratio / count, sums[bin].density_t_mm3 / count}});
    }
    for (const fea::Elastic& elastic : means)
      model.section_of.push_back(static_cast<uint16_t>(numbers[bin_of(elastic)]));
  }

  const LoadedPtr& loaded_;
  const Plan& plan_;
  const FeaRequest& request_;
  Diagnostics& diagnostics_;
  Progress* progress_;
  const StopFlag* stop_;
  Properties properties_;
  std::vector<fea::Cell> cells_;
  std::vector<MaterialId> drawn_;      // of each cell
  std::vector<MaterialId> fractions_;  // whose fields come first
};

fea::ValueField tensors(const std::string& name, const std::string& unit,
                        const std::vector<std::array<double, 6>>& values) {
  fea::ValueField field{name, unit, 6, {}};
  for (const auto& tensor : values)
    for (const double value : tensor) field.values.push_back(static_cast<float>(value));
  return field;
}

}  // namespace

std::optional<fea::Model> fea_model(const LoadedPtr& loaded, const Plan& plan, const fea::Study& study,
                                    const FeaRequest& request, Diagnostics& diagnostics, Progress* progress,
                                    const StopFlag* stop) {
  return ModelMaker(loaded, plan, study, request, diagnostics, progress, stop).make();
}

std::vector<fea::ValueField> fea_brick_fields(const fea::Model& model, const fea::Solution* solution) {
  std::vector<fea::ValueField> fields = model.fields;
  fea::ValueField section{"section", "", 1, {}}, modulus{"modulus", "MPa", 1, {}};
  for (size_t n = 0; n < model.bricks.count(); ++n) {
    section.values.push_back(model.section_of[n]);
    modulus.values.push_back(static_cast<float>(model.elastic(n).modulus_mpa));
  }
  fields.push_back(std::move(section));
  fields.push_back(std::move(modulus));
  if (!solution) return fields;
  fea::ValueField mises{"von Mises stress", "MPa", 1, {}};
  for (const auto& stress : solution->stress_mpa) mises.values.push_back(static_cast<float>(fea::von_mises(stress)));
  fields.push_back(std::move(mises));
  fields.push_back(tensors("stress", "MPa", solution->stress_mpa));
  fields.push_back(tensors("strain", "", solution->strain));
  return fields;
}

std::vector<fea::ValueField> fea_node_fields(const fea::Solution* solution) {
  if (!solution) return {};
  fea::ValueField displacement{"displacement", "mm", 3, {}};
  for (const Vec3& u : solution->displacement_mm)
    for (int axis = 0; axis < 3; ++axis) displacement.values.push_back(static_cast<float>(u[axis]));
  return {displacement};
}

}  // namespace ombre::compile
