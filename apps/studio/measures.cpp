// Measures volumes and masses of a design's materials and named parts.
#include <cmath>
#include <optional>

#include "questions/part_labels.h"
#include "studio/designs.h"
#include "studio/sampled_design.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

// Returns the density in g/cm3, or nothing if the material has none.
std::optional<double> density_of(const design::Material& material) {
  for (const auto& [name, value] : material.properties)
    if (name == "density" && value.number()) return *value.number();
  return std::nullopt;
}

// Sums voxels by materials, and by parts if the design has labels of parts.
class Amounts {
 public:
  // The grids are the fractions; if there are names of parts, the label of parts comes after them.
  Amounts(const compile::GridJob& job, const design::MaterialTable& materials, const std::vector<std::string>& parts) {
    if (!parts.empty()) part_names_.emplace_back("rest");
    part_names_.insert(part_names_.end(), parts.begin(), parts.end());
    for (const compile::Grid& grid : job.grids) {
      if (grid.kind != compile::GridKind::fraction) continue;
      names_.push_back(grid.material->name);
      densities_.push_back(density_of(materials.all()[grid.material->id]));
    }
    of_material_.resize(names_.size());
    of_part_.resize(part_names_.size());
  }

  void add(const voxel::FieldTile& tile) {
    const int64_t values = tile.is_uniform ? 1 : tile.box.voxels();
    const double weight = tile.is_uniform ? static_cast<double>(tile.box.voxels()) : 1;
    for (int64_t n = 0; n < values; ++n) {
      Amount* part = of_part_.empty() ? nullptr : &of_part_[part_at(tile, n)];
      for (size_t m = 0; m < names_.size(); ++m) {
        const double share = weight * static_cast<double>(tile.output(m)[n]);
        of_material_[m].add(share, densities_[m]);
        if (part) part->add(share, densities_[m]);
      }
    }
  }

  double voxels() const {
    double sum = 0;
    for (const Amount& amount : of_material_) sum += amount.voxels;
    return sum;
  }
  DataList materials(double voxel_mm3) const { return described(names_, of_material_, voxel_mm3); }
  DataList parts(double voxel_mm3) const { return described(part_names_, of_part_, voxel_mm3); }
  bool has_parts() const { return !part_names_.empty(); }

 private:
  struct Amount {
    double voxels = 0, weighed = 0;  // in voxels, and in voxels times g/cm3
    bool is_known = true;            // true if all densities are known

    void add(double share, const std::optional<double>& density) {
      voxels += share;
      weighed += share * density.value_or(0);
      if (share > 0 && !density) is_known = false;
    }
  };

  // Returns the index of the part at a voxel; 0 stands for solids without a name.
  size_t part_at(const voxel::FieldTile& tile, int64_t n) const {
    const auto label = std::lround(tile.output(names_.size())[n]);
    return label > 0 && static_cast<size_t>(label) < of_part_.size() ? static_cast<size_t>(label) : 0;
  }

  static DataList described(const std::vector<std::string>& names, const std::vector<Amount>& amounts,
                            double voxel_mm3) {
    constexpr double mm3_of_cm3 = 1000;
    DataList list;
    for (size_t n = 0; n < names.size(); ++n) {
      const Amount& amount = amounts[n];
      DataMembers members{{"name", names[n]}, {"volume_mm3", amount.voxels * voxel_mm3}};
      if (amount.is_known && amount.weighed > 0)
        members.emplace_back("mass_g", amount.weighed * voxel_mm3 / mm3_of_cm3);
      list.emplace_back(std::move(members));
    }
    return list;
  }

  std::vector<std::string> names_, part_names_;  // without part names the design has no labels of parts
  std::vector<std::optional<double>> densities_;
  std::vector<Amount> of_material_, of_part_;
};

compile::LoadedPtr with_labels(const compile::Loaded& loaded) {
  compile::Loaded copy = loaded;
  copy.design = compile::with_part_nodes(copy.design);
  return std::make_shared<const compile::Loaded>(std::move(copy));
}

}  // namespace

Answer measure_answer(OpenDesign& design, const Request&, const StopFlag& stop) {
  const compile::LoadedPtr labelled = with_labels(*design.loaded);
  const std::vector<std::string> parts = compile::part_names(labelled->design);
  compile::GridQuery query = all_fractions();
  if (!parts.empty()) query.attributes = {compile::part_label};
  const SampledDesign sampled = sample(design, labelled, design.bounds, measured_voxels, stop, query);
  Amounts amounts(sampled.job, design.loaded->design.materials, parts);
  const auto take = [&](const compile::GridSlab& slab) {
    for (const voxel::FieldTile& tile : slab.tiles) amounts.add(tile);
  };
  if (!sampled.job.grids.empty()) compile::each_slab(sampled.job, 0, take, nullptr, &stop);
  const double pitch = sampled.pitch_mm(), voxel_mm3 = pitch * pitch * pitch;
  Answer answer{
      {{"volume_mm3", amounts.voxels() * voxel_mm3}, {"pitch_mm", pitch}, {"materials", amounts.materials(voxel_mm3)}},
      {}};
  if (amounts.has_parts()) answer.members.emplace_back("parts", amounts.parts(voxel_mm3));
  return answer;
}

}  // namespace ombre::studio
