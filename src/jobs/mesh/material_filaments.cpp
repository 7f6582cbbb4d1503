#include "jobs/mesh/material_filaments.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/text/record.h"
#include "base/text/text.h"
#include "formats/mesh/mesh_document.h"
#include "formats/slicers/slicer_settings.h"
#include "formats/slicers/snapmaker_mixtures.h"
#include "jobs/common/session.h"
#include "jobs/mesh/mixed_filaments.h"

namespace ombre::jobs {
namespace {

using design::Material;
using formats::FilamentMixture;

constexpr const char* extruder_member = "extruder";
constexpr const char* mixture_member = "mix_layers";
constexpr size_t most_parts = 3;  // PrusaSlicer mixes no more
constexpr const char* mixture_form =
    R"(write the layers of each filament in a cycle, for example {"cyan": 2, "white": 1})";

const Data* member(const Material& material, std::string_view name) {
  const auto found = std::ranges::find(material.properties, name, &DataMembers::value_type::first);
  return found == material.properties.end() ? nullptr : &found->second;
}

bool is_mixed(const Material& material) { return member(material, mixture_member) != nullptr; }

const DataMembers& parts_of(const Material& material) { return *member(material, mixture_member)->members(); }

// Checks the members of a table.
class FilamentCheck {
 public:
  FilamentCheck(const design::MaterialTable& materials, formats::SlicerFlavour flavour, Diagnostics& diagnostics)
      : materials_(materials), flavour_(flavour), reader_(diagnostics) {}

  void check_extruder(const Material& material);
  void check_mixture(const Material& material) const;

 private:
  // Returns the layers of a filament, or 0 if it is wrong.
  int check_part(const Material& material, const DataMembers::value_type& part) const;

  const design::MaterialTable& materials_;
  formats::SlicerFlavour flavour_;
  MemberReader reader_;
  std::map<int, const Material*> by_extruder_;
};

void FilamentCheck::check_extruder(const Material& material) {
  const Data* const data = member(material, extruder_member);
  if (!data) return;
  if (is_mixed(material))
    return reader_.fail(*data, '"' + material.name + "\" is mixed, so it has no extruder of its own",
                        R"(leave "extruder" or "mix_layers" out)");
  const auto extruder = reader_.number(*data, extruder_member, {1, static_cast<double>(formats::most_filaments), true});
  if (!extruder) return;
  const auto [other, is_new] = by_extruder_.emplace(static_cast<int>(*extruder), &material);
  if (!is_new)
    reader_.fail(*data, '"' + other->second->name + "\" and \"" + material.name + "\" have one extruder",
                 "give each filament a number of its own");
}

int FilamentCheck::check_part(const Material& material, const DataMembers::value_type& part) const {
  const Material* const filament = materials_.find(part.first);
  if (!filament || filament->id == 0 || is_mixed(*filament)) {
    reader_.fail(part.second,
                 '"' + material.name + "\" is mixed of \"" + part.first + "\", which is no " +
                     (filament ? "filament" : "material of the file"),
                 mixture_form);
    return 0;
  }
  const auto layers = reader_.number(part.second, part.first, {1, longest_cycle - 1, true});
  return layers ? static_cast<int>(*layers) : 0;
}

void FilamentCheck::check_mixture(const Material& material) const {
  const Data& data = *member(material, mixture_member);
  const DataMembers* const parts = data.members();
  if (!parts || parts->size() < 2 || parts->size() > most_parts)
    return reader_.fail(data, '"' + material.name + "\" is mixed of 2 or 3 filaments", mixture_form);
  int layers = 0;
  std::set<MaterialId> filaments;
  for (const auto& part : *parts) {
    const int own = check_part(material, part);
    if (own == 0) return;
    layers += own;
    filaments.insert(materials_.find(part.first)->id);
  }
  if (filaments.size() < parts->size())
    return reader_.fail(data, '"' + material.name + "\" names a filament twice", mixture_form);
  if (layers > longest_cycle)
    return reader_.fail(data,
                        '"' + material.name + "\": a cycle has at most " + std::to_string(longest_cycle) +
                            " layers, found " + std::to_string(layers),
                        mixture_form);
  if (flavour_ != formats::SlicerFlavour::snapmaker || parts->size() < most_parts) return;
  for (const MaterialId id : filaments)
    if (const Data* const own = member(*materials_.find(id), extruder_member);
        own && own->number() && *own->number() > formats::most_in_pattern)
      reader_.fail(*own,
                   "Snapmaker Orca mixes three filaments of the extruders 1 to " +
                       std::to_string(formats::most_in_pattern) + " only",
                   "give it one of these numbers, or mix two filaments");
}

// The numbers of the filaments of a table, and of the mixtures that are used.
class Numbers {
 public:
  Numbers(const design::MaterialTable& materials, const std::set<MaterialId>& used);

  std::vector<formats::Filament> filaments() const;
  const std::vector<FilamentMixture>& mixtures() const { return mixtures_; }
  size_t of(MaterialId material) const { return extruders_.at(material); }

 private:
  void number(const Material& material, size_t extruder) {
    extruders_[material.id] = extruder;
    by_extruder_[extruder] = &material;
  }
  void number_free(const Material& material);
  FilamentMixture mixture_of(const Material& material) const;

  const design::MaterialTable& materials_;
  std::map<size_t, const Material*> by_extruder_;  // of filaments
  std::map<MaterialId, size_t> extruders_;
  std::vector<FilamentMixture> mixtures_;
};

Numbers::Numbers(const design::MaterialTable& materials, const std::set<MaterialId>& used) : materials_(materials) {
  for (const Material& material : materials.all())
    if (const Data* const own = member(material, extruder_member))
      number(material, static_cast<size_t>(*own->number()));
  std::set<MaterialId> filaments, mixed;
  for (const MaterialId id : used) {
    const Material& material = *materials.find(id);
    (is_mixed(material) ? mixed : filaments).insert(id);
    if (!is_mixed(material)) continue;
    for (const auto& [name, layers] : parts_of(material)) filaments.insert(materials.find(name)->id);
  }
  for (const MaterialId id : filaments) number_free(*materials.find(id));
  const size_t first = by_extruder_.rbegin()->first + 1;
  for (const MaterialId id : mixed) {
    extruders_[id] = first + mixtures_.size();
    mixtures_.push_back(mixture_of(*materials.find(id)));
  }
}

void Numbers::number_free(const Material& material) {
  if (extruders_.contains(material.id)) return;
  size_t extruder = 1;
  while (by_extruder_.contains(extruder)) ++extruder;
  number(material, extruder);
}

FilamentMixture Numbers::mixture_of(const Material& material) const {
  FilamentMixture mixture{material.name, material.colour, {}};
  for (const auto& [name, layers] : parts_of(material))
    mixture.parts.push_back({static_cast<uint32_t>(of(materials_.find(name)->id)), static_cast<int>(*layers.number())});
  std::ranges::sort(mixture.parts, {}, &FilamentMixture::Part::extruder);
  return mixture;
}

std::vector<formats::Filament> Numbers::filaments() const {
  std::vector<formats::Filament> filaments;
  for (const auto& [extruder, material] : by_extruder_) {
    while (filaments.size() + 1 < extruder)
      filaments.push_back({"filament " + std::to_string(filaments.size() + 1), formats::MeshMaterial{}.colour, {}, {}});
    filaments.push_back({material->name, material->colour, {}, {}});
  }
  return filaments;
}

std::string recipe(const FilamentMixture& mixture, const std::vector<formats::Filament>& filaments) {
  std::vector<std::string> parts;
  for (const FilamentMixture::Part& part : mixture.parts)
    parts.push_back(std::to_string(part.layers) + " of " + filaments[part.extruder - 1].name);
  return mixture.name + ": layers " + join(parts, ", ");
}

// Snapmaker Orca's patterns name a third filament by one digit.
void check_patterns(const formats::SlicerProject& project) {
  for (const formats::FilamentMixture& mixture : project.mixtures) {
    if (mixture.parts.size() < 3 || mixture.parts.back().extruder <= formats::most_in_pattern) continue;
    const uint32_t extruder = mixture.parts.back().extruder;
    throw WrongArgument('"' + mixture.name + "\" has three filaments, one of them on extruder " +
                        std::to_string(extruder) + ", and Snapmaker Orca mixes three of the extruders 1 to " +
                        std::to_string(formats::most_in_pattern) + " only; give \"" +
                        project.filaments[extruder - 1].name + "\" an \"extruder\" from 1 to " +
                        std::to_string(formats::most_in_pattern) + " in the materials file");
  }
}

}  // namespace

bool describes_filaments(const design::MaterialTable& materials) {
  return std::ranges::any_of(materials.all(), [](const Material& material) {
    return member(material, extruder_member) || is_mixed(material);
  });
}

void check_material_filaments(const design::MaterialTable& materials, formats::SlicerFlavour flavour,
                              Diagnostics& diagnostics) {
  FilamentCheck check(materials, flavour, diagnostics);
  for (const Material& material : materials.all()) {
    check.check_extruder(material);
    if (is_mixed(material)) check.check_mixture(material);
  }
}

void add_material_filaments(const design::MaterialTable& materials, const compile::MeshedDesign& made,
                            const Events& events, formats::MeshDocument& document) {
  std::set<MaterialId> used;
  for (const compile::RegionBody& body : made.bodies) used.insert(*body.region.material);
  const Numbers numbers(materials, used);
  document.project.filaments = numbers.filaments();
  document.project.mixtures = numbers.mixtures();
  for (size_t n = 0; n < made.bodies.size(); ++n)
    formats::set_extruder(document.bodies[n], numbers.of(*made.bodies[n].region.material));
  for (const FilamentMixture& mixture : numbers.mixtures()) events.say(recipe(mixture, document.project.filaments));
}

void check_filament_numbers(const formats::MeshDocument& document, formats::SlicerFlavour flavour,
                            bool are_of_materials) {
  const formats::SlicerProject& project = document.project;
  if (flavour == formats::SlicerFlavour::snapmaker) check_patterns(project);
  const bool mixes = !project.mixtures.empty();
  const size_t most = mixes ? formats::most_extruders(flavour) : formats::most_filaments;
  const auto is_beyond = [&](const formats::MeshBody& body) { return formats::body_extruder(body) > most; };
  if (std::ranges::none_of(document.bodies, is_beyond)) return;
  const std::string program = std::string(formats::program_of(flavour)), limit = std::to_string(most);
  if (mixes)
    throw WrongArgument("mixtures are numbered after the last filament, which has number " +
                        std::to_string(project.filaments.size()) + ", and a project of " + program + " has at most " +
                        limit +
                        " filaments and mixtures; give filaments smaller numbers by "
                        "\"extruder\", or use fewer materials with \"mix_layers\"");
  const std::string bodies = std::to_string(document.bodies.size());
  if (are_of_materials)
    throw WrongArgument(bodies + " bodies have a filament each, and a project has at most " + limit +
                        "; use fewer materials, or mixtures by \"mix_layers\"");
  throw WrongArgument(bodies + " bodies have a filament each, and a project has at most " + limit + "; write " +
                      spelled::option("--setting", "extruder=1") + " for one filament");
}

}  // namespace ombre::jobs
