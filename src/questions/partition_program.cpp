// Makes programs that cut a design into regions.
#include "questions/partition_program.h"

#include <algorithm>

#include "base/text/text.h"
#include "questions/part_labels.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using program::Field;
using program::Point;

// Returns g of a closed box, negative inside.
Field box_distance(const Box& box, const Point& p) {
  const Field coordinates[] = {p.x, p.y, p.z};
  std::vector<Field> faces;
  for (int axis = 0; axis < 3; ++axis) {
    faces.push_back(p.constant(box.lo[axis]) - coordinates[axis]);
    faces.push_back(coordinates[axis] - p.constant(box.hi[axis]));
  }
  return program::fold(faces, [](Field a, Field b) { return max(a, b); });
}

// Returns the number, counted from 1, of the greatest score; the first of equal ones.
Field number_of_greatest(const std::vector<Field>& scores) {
  program::Builder& builder = *scores.front().builder;
  Field best = scores.front(), number = builder.constant(1);
  for (size_t n = 1; n < scores.size(); ++n) {
    const Field wins = less(best, scores[n]);
    number = select(wins, builder.constant(static_cast<double>(n + 1)), number);
    best = max(best, scores[n]);
  }
  return number;
}

Field number_of_band(Field score, const std::vector<double>& borders) {
  Field number = score.builder->constant(1);
  for (const double border : borders) number = number + less_equal(score.builder->constant(border), score);
  return number;
}

std::string list_names(const std::vector<std::string>& names) {
  return names.empty() ? "there is none" : "there are " + join(names, ", ");
}

class RegionBuilder {
 public:
  RegionBuilder(const design::Design& design, const RegionRule& rule, const design::NodePtr& shape,
                Diagnostics& diagnostics)
      : design_(design), rule_(rule), diagnostics_(diagnostics), question_(design, {.shape = shape}) {}

  std::optional<RegionProgram> build(const Box& box) {
    if (!add_scores()) return std::nullopt;
    const Field within = box_distance(box, question_.point());
    const Field inside = logical_and(question_.inside(), within <= 0);
    const Field label = select(inside, number(), question_.builder().constant(0));
    program::Outputs details{{"region", label}, {"distance", max(question_.distance(), within)}};
    for (const Field& score : scores_) details.emplace_back("score " + std::to_string(details.size() - 1), score);
    auto label_program = question_.program({{"region", label}}, diagnostics_);
    auto details_program = question_.program(details, diagnostics_);
    if (!label_program || !details_program) return std::nullopt;
    made_.partition.label = std::move(*label_program);
    made_.partition.details = surface::LocalPrograms(std::move(*details_program), box);
    made_.partition.regions = made_.regions.size();
    return std::move(made_);
  }

 private:
  bool add_scores() {
    switch (rule_.kind) {
      case RegionRule::Kind::whole:
        add_whole();
        return true;
      case RegionRule::Kind::materials:
        return add_materials();
      case RegionRule::Kind::parts:
        return add_parts();
      case RegionRule::Kind::fraction:
        return add_fraction();
      case RegionRule::Kind::attribute:
        return add_attribute();
      case RegionRule::Kind::crossed:
        return add_crossed();
    }
    return false;
  }

  Field number() {
    if (scores_.empty()) return question_.builder().constant(1);
    if (made_.partition.division == surface::Division::greatest) return number_of_greatest(scores_);
    return number_of_band(scores_.front(), made_.partition.borders);
  }

  // Adds the region of all that is not mostly void, and that of the rest if the composition can have void.
  void add_whole() {
    made_.regions.push_back({design_.parts.size() == 1 ? design_.parts[0].name : "", {}, {}, {}});
    const design::Composition composition = question_.composition();
    const auto is_void = [](const auto& fraction) { return fraction.first == void_material; };
    const auto empty = std::ranges::find_if(composition.fractions, is_void);
    if (empty == composition.fractions.end() || composition.fractions.size() < 2) return;
    made_.partition.division = surface::Division::greatest;
    scores_ = {question_.builder().constant(1) - empty->second, empty->second};
    made_.regions.push_back({design_.materials.all()[void_material].name, void_material, {}, {}});
  }

  bool add_materials() {
    made_.partition.division = surface::Division::greatest;
    for (const auto& [id, fraction] : question_.composition().fractions) {
      scores_.push_back(fraction);
      made_.regions.push_back({design_.materials.all()[id].name, id, {}, {}});
    }
    return true;
  }

  // Adds a region for each part; the region "rest", of solids without a name, comes first.
  bool add_parts() {
    const design::AttributeDeclaration* declared = question_.declaration(part_label);
    if (!declared) {
      report_nameless_parts(design_, diagnostics_);
      return false;
    }
    const auto label = question_.attribute(part_label, diagnostics_);
    if (!label) return false;
    made_.partition.division = surface::Division::greatest;
    std::vector<std::string> names{"rest"};
    names.insert(names.end(), declared->labels.begin(), declared->labels.end());
    for (size_t n = 0; n < names.size(); ++n) {
      scores_.push_back(
          question_.builder().apply(program::Op::equal, *label, label->builder->constant(static_cast<double>(n))));
      made_.regions.push_back({names[n], {}, {}, {}});
    }
    return true;
  }

  bool add_fraction() {
    const design::Material* material = design_.materials.find(rule_.of);
    std::vector<std::string> names;
    for (const auto& [id, part] : shares(question_.composition())) {
      if (material && material->id == id) {
        scores_.push_back(part);
        add_bands(material->name, 100, " %");
        return true;
      }
      names.push_back(design_.materials.all()[id].name);
    }
    diagnostics_.error(Code::unknown_material, question_.solid()->where(),
                       "the design has no material \"" + rule_.of + "\"; " + list_names(names), {},
                       {{"material", rule_.of}});
    return false;
  }

  bool add_attribute() {
    const auto value = question_.attribute(rule_.of, diagnostics_);
    if (!value) return false;
    scores_.push_back(*value);
    add_bands(rule_.of, 1, unit_text(rule_.of));
    return true;
  }

  void add_bands(const std::string& subject, double scale, const std::string& unit) {
    made_.partition.borders = rule_.borders;
    const size_t bands = rule_.borders.size() + 1;
    for (size_t n = 0; n < bands; ++n) made_.regions.push_back(band(rule_, n, subject, scale, unit));
  }

  Region band(const RegionRule& rule, size_t n, const std::string& subject, double scale,
              const std::string& unit) const {
    Region region;
    if (n > 0) region.least = rule.borders[n - 1];
    if (n < rule.borders.size()) region.greatest = rule.borders[n];
    region.name = std::string(subject).append(range_text(region, scale)).append(unit);
    if (rule.kind == RegionRule::Kind::attribute && (rule.range || !rule.borders.empty()))
      region.attributes.emplace_back(rule.of, middle(rule, region));
    const design::Material* material =
        rule.kind == RegionRule::Kind::fraction ? design_.materials.find(rule.of) : nullptr;
    if (material) region.fractions.emplace_back(material->id, middle(rule, region));
    return region;
  }

  // Returns the middle of a band. The first and last band reach to the ends of the range; if that is not known, they
  // are as wide as their neighbours.
  static double middle(const RegionRule& rule, const Region& region) {
    const std::vector<double>& borders = rule.borders;
    const double usual =
        borders.size() > 1 ? (borders.back() - borders.front()) / static_cast<double>(borders.size() - 1) : 0;
    const double lo = rule.range ? rule.range->lo : borders.front() - usual;
    const double hi = rule.range ? rule.range->hi : borders.back() + usual;
    return (region.least.value_or(lo) + region.greatest.value_or(hi)) / 2;
  }

  // Adds a region for each combination of bands. Its score is the least distance of a value from the ends of its band,
  // so it is 0 on the region's borders, as is that of the neighbour.
  bool add_crossed() {
    made_.partition.division = surface::Division::greatest;
    std::vector<Region> regions{{}};
    std::vector<Field> scores{{}};
    for (const RegionRule& rule : rule_.crossed) {
      const auto value = question_.value(rule.of, diagnostics_);
      if (!value) return false;
      if (regions.size() * (rule.borders.size() + 1) > most_crossed_regions) return refuse_many();
      cross(rule, *value, regions, scores);
    }
    made_.regions = std::move(regions);
    scores_ = std::move(scores);
    return true;
  }

  bool refuse_many() {
    diagnostics_.error(
        Code::too_large, question_.solid()->where(),
        "the bands of all values cross in more than " + std::to_string(most_crossed_regions) + " regions",
        "choose fewer bands");
    return false;
  }

  void cross(const RegionRule& rule, Field value, std::vector<Region>& regions, std::vector<Field>& scores) {
    const bool is_fraction = rule.kind == RegionRule::Kind::fraction;
    const std::string unit = is_fraction ? " %" : unit_text(rule.of);
    std::vector<Region> crossed;
    std::vector<Field> margins;
    for (size_t r = 0; r < regions.size(); ++r)
      for (size_t n = 0; n <= rule.borders.size(); ++n) {
        Region region = band(rule, n, rule.of, is_fraction ? 100 : 1, unit);
        const Field margin = margin_of(value, region);
        region.name = regions[r].name.empty() ? region.name : regions[r].name + ", " + region.name;
        region.attributes.insert(region.attributes.begin(), regions[r].attributes.begin(), regions[r].attributes.end());
        region.fractions.insert(region.fractions.begin(), regions[r].fractions.begin(), regions[r].fractions.end());
        crossed.push_back(std::move(region));
        margins.push_back(scores[r] ? min(scores[r], margin) : margin);
      }
    regions = std::move(crossed);
    scores = std::move(margins);
  }

  Field margin_of(Field value, const Region& region) {
    const Field width =
        question_.builder().constant(region.least && region.greatest ? *region.greatest - *region.least : 1);
    const Field above = region.least ? value - *region.least : width;
    const Field below = region.greatest ? *region.greatest - value : width;
    return min(above, below);
  }

  std::string unit_text(const std::string& attribute) {
    const design::AttributeDeclaration* declared = question_.declaration(attribute);
    return declared && !declared->unit.empty() && declared->unit != "1" ? " " + declared->unit : "";
  }

  static std::string range_text(const Region& region, double scale) {
    const auto text = [&](double value) { return format_rounded(value * scale, 4); };
    if (region.least && region.greatest)
      return std::string(" ").append(text(*region.least)).append(" to ").append(text(*region.greatest));
    if (region.least) return " from " + text(*region.least);
    return region.greatest ? " below " + text(*region.greatest) : "";
  }

  const design::Design& design_;
  const RegionRule& rule_;
  Diagnostics& diagnostics_;
  Question question_;
  std::vector<Field> scores_;
  RegionProgram made_;
};

}  // namespace

std::optional<RegionProgram> build_region_program(const design::Design& design, const Box& box, const RegionRule& rule,
                                                  Diagnostics& diagnostics, const design::NodePtr& shape) {
  return RegionBuilder(design, rule, shape, diagnostics).build(box);
}

}  // namespace ombre::compile
