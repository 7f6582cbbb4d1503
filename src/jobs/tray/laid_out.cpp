#include "jobs/tray/laid_out.h"

#include <algorithm>
#include <cmath>

#include "base/text/json.h"
#include "base/text/text.h"
#include "jobs/tray/pack.h"
#include "load/node_registry.h"
#include "questions/build.h"
#include "voxel/lattice.h"

namespace ombre::compile {
namespace {

constexpr double rounding = 1e-6;  // of a voxel

class TrayPacker {
 public:
  TrayPacker(const voxel::Printer& printer, double gap_mm, Diagnostics& diagnostics)
      : printer_(printer), gap_mm_(gap_mm), diagnostics_(diagnostics) {}

  std::optional<TrayDesign> run(const std::vector<TrayItem>& items) {
    for (const TrayItem& item : items)
      if (!measure(item)) return std::nullopt;
    const auto places = pack(rectangles_, tray(), gap());
    const auto placed =
        static_cast<uint64_t>(std::ranges::count_if(places, [](const auto& p) { return p.has_value(); }));
    if (placed < places.size()) return refuse(items, placed, places.size());
    design::Design design;
    design.materials = items.front().loaded->design.materials;
    size_t n = 0;
    for (size_t item = 0; item < items.size(); ++item)
      for (int64_t copy = 1; copy <= items[item].count; ++copy)
        if (!add(items[item], boxes_[item], copy, *places[n++], design)) return std::nullopt;
    TrayDesign made{design::to_data(design), {}};
    for (const design::Part& part : design.parts) made.parts.push_back(part.name);
    return made;
  }

 private:
  Pitch pitch(size_t axis) const { return printer_.pitch[axis]; }
  Rectangle gap() const {
    const auto along = [&](size_t axis) {
      return static_cast<int64_t>(std::ceil(gap_mm_ / pitch(axis).mm() - rounding));
    };
    return {along(0), along(1)};
  }
  Rectangle tray() const {
    const auto along = [&](int axis) {
      return static_cast<int64_t>((*printer_.build_mm)[axis] / pitch(static_cast<size_t>(axis)).mm() + rounding);
    };
    return {along(0), along(1)};
  }

  bool measure(const TrayItem& item) {
    design::Design design = item.loaded->design;
    const SourceRange where{item.loaded->source, 0, 0};
    if (design.sampling)
      diagnostics_.warning(where, "root() of " + item.name + " is left out: all of its solids stand on the tray");
    design.sampling.reset();
    const auto box = design_box(design, diagnostics_);
    if (!box) return false;
    const double build = printer_.build_mm->z;
    if (box->size().z > build * (1 + rounding)) {
      diagnostics_.error(Code::outside_box, where,
                         item.name + " is " + format_rounded(box->size().z) + " mm high, more than the " +
                             format_rounded(build) + " mm that " + printer_.title + " builds",
                         "turn or split it, or choose another printer");
      return false;
    }
    boxes_.push_back(*box);
    const Rectangle size{voxel::voxels_along(box->size().x, pitch(0)), voxel::voxels_along(box->size().y, pitch(1))};
    rectangles_.insert(rectangles_.end(), static_cast<size_t>(item.count), size);
    return true;
  }

  std::nullopt_t refuse(const std::vector<TrayItem>& items, uint64_t placed, size_t all) {
    diagnostics_.error(
        Code::outside_box, {items.front().loaded->source, 0, 0},
        "of " + format_count(all) + " parts " + format_count(placed) + " fit onto the tray of " + printer_.title +
            ", " + format_rounded(printer_.build_mm->x) + " x " + format_rounded(printer_.build_mm->y) +
            " mm, with gaps of " + format_rounded(gap_mm_) + " mm",
        "ask for fewer with " + spelled::option("--count") + ", or for less with " + spelled::option("--gap"));
    return std::nullopt;
  }

  // Adds a copy of a design, whose box begins at this voxel of the tray.
  bool add(const TrayItem& item, const Box& box, int64_t copy, const PackPlace& place, design::Design& design) {
    const Vec3 by{pitch(0).times(static_cast<double>(place.x)) - box.lo.x,
                  pitch(1).times(static_cast<double>(place.y)) - box.lo.y, -box.lo.z};
    const design::NodeType& type = *node_registry().find("translate");
    const auto* const parameter = &type.parameters[static_cast<size_t>(type.parameter("by"))];
    const std::vector<design::Part>& parts = item.loaded->design.parts;
    for (const design::Part& part : parts) {
      const design::Reader reader{design.materials, diagnostics_, nullptr, part.solid->where(), "translate", ""};
      const design::NodePtr moved =
          design::make_node(type, {{parameter, Data(DataList{by.x, by.y, by.z})}}, {part.solid}, reader);
      if (!moved) return false;
      const std::string name = item.name + '_' + std::to_string(copy);
      design.parts.push_back({parts.size() == 1 ? name : name + '_' + part.name, moved});
    }
    return true;
  }

  const voxel::Printer& printer_;
  double gap_mm_ = 0;
  Diagnostics& diagnostics_;
  std::vector<Box> boxes_;             // of the designs
  std::vector<Rectangle> rectangles_;  // of all copies
};

bool have_same_materials(const std::vector<TrayItem>& items, Diagnostics& diagnostics) {
  const std::string first = print_json_line(items.front().loaded->design.materials.to_data());
  for (const TrayItem& item : items) {
    if (print_json_line(item.loaded->design.materials.to_data()) == first) continue;
    diagnostics.error(Code::option, {item.loaded->source, 0, 0},
                      item.name + " has other materials than " + items.front().name,
                      "give all designs the same with " + spelled::option("--materials"));
    return false;
  }
  return true;
}

}  // namespace

std::optional<TrayDesign> laid_out(const std::vector<TrayItem>& items, const voxel::Printer& printer, double gap_mm,
                                   Diagnostics& diagnostics) {
  if (!have_same_materials(items, diagnostics)) return std::nullopt;
  return TrayPacker(printer, gap_mm, diagnostics).run(items);
}

}  // namespace ombre::compile
