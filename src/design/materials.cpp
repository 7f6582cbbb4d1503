#include "design/materials.h"

#include <algorithm>
#include <iterator>

#include "base/text/record.h"
#include "base/text/text.h"

namespace ombre::design {
namespace {

constexpr size_t most_materials = 255;  // ids fit into a byte, and 0 is void
constexpr std::array<const char*, 4> colour_names{"r", "g", "b", "a"};

ombre::Field<Material> colour_field(size_t channel, const std::string& meaning) {
  const std::string name = colour_names[channel];
  return ombre::Field<Material>(name,
                                [=](Material& material, const Data& data, const MemberReader& reader) {
                                  const auto shade = reader.number(data, name, {0, 255, true});
                                  if (shade) material.colour[channel] = static_cast<uint8_t>(*shade);
                                })
      .means(meaning);
}

const Record<Material>& material_record() {
  using M = Material;
  const char* const all_channels = "give r, g, b (and a) from 0 to 255";
  static const Record<M> record =
      Record<M>("a material",
                {field::text("name", &M::name)
                     .required(R"(write for example "name": "red")")
                     .means("what designs call it, in letters of either case"),
                 colour_field(0, "red of its colour in images, a whole number from 0 to 255").required(all_channels),
                 colour_field(1, "green").required(all_channels), colour_field(2, "blue").required(all_channels),
                 colour_field(3, "opacity (default 255)"),
                 field::flag("support", &M::is_support)
                     .means("`true` for the one that [supports](../user/supports.md) are made of")})
          .open();
  return record;
}

bool is_property(const std::string& member) {
  return member != "name" && std::ranges::find(colour_names, member) == colour_names.end();
}

}  // namespace

const std::vector<MemberInfo>& material_members() { return material_record().members(); }

MaterialTable::MaterialTable() : all_(std::make_shared<std::vector<Material>>()) {
  all_->push_back({"void", 0, {0, 0, 0, 0}, {}});
}

std::optional<MaterialTable> MaterialTable::read(const Data& data, Diagnostics& diagnostics) {
  const MemberReader reader(diagnostics);
  const size_t before = reader.error_count();
  const Data* const list = data.find("materials");
  if (!list)
    reader.fail_missing(data, "a design or a file of materials", "materials",
                        R"(write for example "materials": [{"name": "red", "r": 255, "g": 0, "b": 0}])");
  const DataList* const entries = list ? reader.list(*list, "materials") : nullptr;
  if (!entries) return std::nullopt;
  MaterialTable table;
  for (const Data& entry : *entries)
    if (!table.add(entry, reader)) break;
  if (reader.error_count() > before) return std::nullopt;
  if (table.all_->size() > 1) return table;
  reader.fail(*list, "this file defines no material");
  return std::nullopt;
}

bool MaterialTable::add(const Data& entry, const MemberReader& reader) {
  Material material;
  if (!material_record().read(entry, material, reader)) return true;
  std::ranges::copy_if(*entry.members(), std::back_inserter(material.properties), is_property,
                       &DataMembers::value_type::first);
  std::vector<Material>& all = *all_;
  if (to_lower(material.name) == "void") {
    all[0].properties = std::move(material.properties);  // void keeps its id and colour
    return true;
  }
  if (all.size() > most_materials) {
    reader.fail(entry, "a file may define at most " + std::to_string(most_materials) + " materials");
    return false;
  }
  if (find(material.name)) reader.fail(*entry.find("name"), "the material \"" + material.name + "\" is defined twice");
  if (const Material* other = marked_as_support(); other && material.is_support)
    reader.fail(entry, '"' + other->name + "\" and \"" + material.name + "\" are both marked as support",
                "leave \"support\": true with one of them; support(material=...) takes the other");
  material.id = static_cast<MaterialId>(all.size());
  all.push_back(std::move(material));
  return true;
}

Data MaterialTable::to_data() const {
  DataList list;
  for (size_t i = 1; i < all_->size(); ++i) {
    const Material& m = (*all_)[i];
    DataMembers entry{{"name", Data(m.name)}};
    for (size_t c = 0; c < m.colour.size(); ++c) entry.emplace_back(colour_names[c], number(m.colour[c]));
    for (const auto& property : m.properties) entry.push_back(property);
    list.emplace_back(std::move(entry));
  }
  return Data(DataMembers{{"materials", Data(std::move(list))}});
}

const Material* MaterialTable::find(std::string_view name) const {
  for (const Material& material : *all_)
    if (material.name == name) return &material;
  const std::string lower = to_lower(name);
  for (const Material& material : *all_)
    if (to_lower(material.name) == lower) return &material;
  return nullptr;
}

const Material* MaterialTable::marked_as_support() const {
  const auto found = std::ranges::find_if(*all_, &Material::is_support);
  return found == all_->end() ? nullptr : &*found;
}

const Material* MaterialTable::support() const {
  const Material* const marked = marked_as_support();
  return marked ? marked : find("support");
}

std::vector<std::string> MaterialTable::names() const {
  std::vector<std::string> names;
  for (const Material& material : *all_) names.push_back(material.name);
  return names;
}

}  // namespace ombre::design
