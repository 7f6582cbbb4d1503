#include "jobs/fea/fea_sections.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using fea::Physics;

// Upper limit of Poisson's ratios, since the bulk modulus of an incompressible material is infinite.
constexpr double most_poissons_ratio = 0.49;
constexpr size_t most_section_count = 60'000;  // limit of 16-bit numbers of sections

// The properties of a section, without its name.
struct Property {
  fea::Elastic elastic;
  double conductivity = 0;

  void add(double share, const Property& of) {
    elastic.modulus_mpa += share * of.elastic.modulus_mpa;
    elastic.poissons_ratio += share * of.elastic.poissons_ratio;
    elastic.density_t_mm3 += share * of.elastic.density_t_mm3;
    conductivity += share * of.conductivity;
  }
};

// The properties of materials, some of which may be missing.
class Properties {
 public:
  Properties(const design::MaterialTable& table, const fea::Study& study, Diagnostics& diagnostics)
      : table_(table), study_(study), diagnostics_(diagnostics) {
    const auto check = [&](const std::string& name) {
      if (!table.find(name))
        diagnostics.error(Code::unknown_material, study.where,
                          "the study gives properties to \"" + name + "\", which is no material",
                          did_you_mean(name, table.names()), {{"material", name}});
    };
    for (const auto& [name, elastic] : study.materials) check(name);
    for (const auto& [name, conductivity] : study.conductivities) check(name);
  }

  // Returns the properties of a material, and adds a diagnostic when there are none.
  Property of(MaterialId id) {
    const auto known = known_.find(id);
    if (known != known_.end()) return known->second;
    const design::Material& material = *table_.find(id);
    return known_[id] = study_.physics == Physics::mechanics ? elastic_of(material) : conducting(material);
  }

 private:
  Property elastic_of(const design::Material& material) {
    const auto given = study_.materials.find(to_lower(material.name));
    std::optional<fea::Elastic> elastic;
    if (given != study_.materials.end())
      elastic = given->second;
    else
      elastic = fea::read_elastic(material.properties, study_.where, diagnostics_);
    if (!elastic)
      diagnostics_.error(Code::study_value, study_.where,
                         "there are no elastic properties of \"" + material.name + "\"",
                         "write them into the study, \"materials\": {\"" + material.name +
                             R"(": {"modulus_mpa": 2850, "poissons_ratio": 0.39}}, or into the materials file)");
    return {compressible(elastic.value_or(fea::Elastic{1, 0, 0}), material.name), 0};
  }

  Property conducting(const design::Material& material) {
    const auto given = study_.conductivities.find(to_lower(material.name));
    std::optional<double> conductivity;
    if (given != study_.conductivities.end())
      conductivity = given->second;
    else
      conductivity = fea::read_conductivity(material.properties, study_.physics, diagnostics_);
    const std::string& name = fea::words_of(study_.physics).conductivity.member;
    if (!conductivity)
      diagnostics_.error(Code::study_value, study_.where, "there is no " + name + " of \"" + material.name + "\"",
                         "write it into the study, \"materials\": {\"" + material.name + "\": {\"" + name +
                             "\": 0.2}}, or into the materials file");
    return {{}, conductivity.value_or(1)};
  }

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
  std::map<MaterialId, Property> known_;
};

class SectionMaker {
 public:
  SectionMaker(const Loaded& loaded, const fea::Study& study, const FeaRequest& request,
               const ElementMaterials& materials, Diagnostics& diagnostics)
      : loaded_(loaded),
        request_(request),
        materials_(materials),
        diagnostics_(diagnostics),
        is_mechanics_(study.physics == Physics::mechanics),
        attribute_(is_mechanics_ ? request.modulus : request.conductivity),
        properties_(loaded.design.materials, study, diagnostics) {}

  std::optional<Sections> make() {
    if (attribute_ || request_.assign == FeaRequest::Assign::mix)
      mix();
    else
      draw();
    if (diagnostics_.has_errors()) return std::nullopt;
    return std::move(made_);
  }

 private:
  void draw() {
    std::map<MaterialId, uint16_t> numbers;
    for (const MaterialId id : materials_.drawn) numbers.emplace(id, static_cast<uint16_t>(0));
    for (auto& [id, number] : numbers) {
      number = static_cast<uint16_t>(made_.sections.size());
      add_section(loaded_.design.materials.find(id)->name, properties_.of(id));
    }
    for (const MaterialId id : materials_.drawn) made_.section_of.push_back(numbers[id]);
  }

  void add_section(const std::string& name, const Property& property) {
    made_.sections.push_back({name, property.elastic, property.conductivity});
  }

  double& main_value(Property& property) const {
    return is_mechanics_ ? property.elastic.modulus_mpa : property.conductivity;
  }

  // Returns the attribute that replaces the materials' main property; null, and adds a diagnostic, when the design
  // lacks it.
  const fea::ValueField* given_field() {
    const auto& fields = *materials_.fields;
    for (size_t f = materials_.fractions.size(); f < fields.size(); ++f)
      if (fields[f].name == *attribute_) return &fields[f];
    report_unknown_attribute(loaded_.design, *attribute_, diagnostics_);
    return nullptr;
  }

  // Returns means of the materials' properties by their fractions; the main property may come from an attribute.
  std::vector<Property> mean_properties() {
    const fea::ValueField* given = attribute_ ? given_field() : nullptr;
    std::vector<Property> means(materials_.count);
    for (size_t f = 0; f < materials_.fractions.size(); ++f) {
      const std::vector<float>& shares = (*materials_.fields)[f].values;
      // A possible material that no element has needs no properties.
      if (std::ranges::all_of(shares, [](float share) { return share == 0; })) continue;
      const Property here = properties_.of(materials_.fractions[f]);
      for (size_t n = 0; n < means.size(); ++n) means[n].add(shares[n], here);
    }
    size_t wrong = 0;
    for (size_t n = 0; given && n < means.size(); ++n) {
      main_value(means[n]) = given->values[n];
      if (!(given->values[n] > 0) || !std::isfinite(given->values[n])) ++wrong;
    }
    if (wrong > 0)
      diagnostics_.error(
          Code::study_value, {loaded_.source, 0, 0},
          "the attribute \"" + *attribute_ + "\" is no " + (is_mechanics_ ? "modulus" : "conductivity") +
              " above 0 in " + format_count(wrong) + " of the elements",
          is_mechanics_ ? "let it be in MPa, for example attribute(\"" + *attribute_ + "\", \"1 + z\", unit=\"MPa\")"
                        : "let it be above 0 everywhere inside");
    return means;
  }

  // Joins elements of about the same main property to sections, whose properties are their means.
  void mix() {
    std::vector<Property> means = mean_properties();
    if (diagnostics_.has_errors()) return;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (Property& mean : means) {
      low = std::min(low, std::log(main_value(mean)));
      high = std::max(high, std::log(main_value(mean)));
    }
    const double span = high - low;
    const size_t bins = std::clamp<size_t>(request_.most_sections, 1, most_section_count);
    const auto bin_of = [&](Property& property) {
      if (!(span > 0)) return size_t{0};
      const double at = (std::log(main_value(property)) - low) / span * static_cast<double>(bins);
      return std::min(static_cast<size_t>(std::max(at, 0.0)), bins - 1);
    };
    std::vector<Property> sums(bins);
    std::vector<size_t> counts(bins), numbers(bins);
    for (Property& mean : means) {
      const size_t bin = bin_of(mean);
      ++counts[bin];
      sums[bin].add(1, mean);
    }
    for (size_t bin = 0; bin < bins; ++bin) {
      if (counts[bin] == 0) continue;
      Property mean;
      mean.add(1 / static_cast<double>(counts[bin]), sums[bin]);
      numbers[bin] = made_.sections.size();
      add_section("mix_" + std::to_string(numbers[bin] + 1), mean);
    }
    for (Property& mean : means) made_.section_of.push_back(static_cast<uint16_t>(numbers[bin_of(mean)]));
  }

  const Loaded& loaded_;
  const FeaRequest& request_;
  const ElementMaterials& materials_;
  Diagnostics& diagnostics_;
  bool is_mechanics_;
  std::optional<std::string> attribute_;
  Properties properties_;
  Sections made_;
};

}  // namespace

std::optional<Sections> make_sections(const Loaded& loaded, const fea::Study& study, const FeaRequest& request,
                                      const ElementMaterials& materials, Diagnostics& diagnostics) {
  return SectionMaker(loaded, study, request, materials, diagnostics).make();
}

}  // namespace ombre::compile
