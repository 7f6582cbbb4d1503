#include "design/materials.h"

#include "base/text/text.h"

namespace ombre::design {
namespace {

constexpr size_t most_materials = 255;  // ids fit into a byte, and 0 is void

std::optional<uint8_t> channel(const Data& entry, std::string_view key, std::optional<uint8_t> otherwise,
                               Diagnostics& diagnostics) {
  const Data* value = entry.find(key);
  if (!value) {
    if (otherwise) return otherwise;
    diagnostics.error(entry.where, "this material has no \"" + std::string(key) + "\"",
                      "give r, g, b (and a) from 0 to 255");
    return std::nullopt;
  }
  const double* number = value->number();
  if (number && *number >= 0 && *number <= 255 && *number == static_cast<int>(*number))
    return static_cast<uint8_t>(*number);
  diagnostics.error(value->where, "expected a whole number from 0 to 255, found " + describe(*value));
  return std::nullopt;
}

// True if the material is marked as support. Adds a diagnostic if the property is no truth value.
bool is_marked_as_support(const DataMembers& properties, Diagnostics& diagnostics) {
  for (const auto& [key, value] : properties) {
    if (key != "support") continue;
    if (const bool* flag = value.boolean()) return *flag;
    diagnostics.error(value.where, "expected true or false, found " + describe(value),
                      "write \"support\": true for the material that supports are made of");
  }
  return false;
}

}  // namespace

MaterialTable::MaterialTable() : all_(std::make_shared<std::vector<Material>>()) {
  all_->push_back({"void", 0, {0, 0, 0, 0}, {}});
}

std::optional<MaterialTable> MaterialTable::read(const Data& data, Diagnostics& diagnostics) {
  const Data* entries = data.find("materials");
  if (!entries || !entries->list()) {
    diagnostics.error(entries ? entries->where : data.where, "expected an object with a list \"materials\"",
                      "write {\"materials\": [{\"name\": \"red\", \"r\": 255, \"g\": 0, \"b\": 0, \"a\": 255}]}");
    return std::nullopt;
  }
  MaterialTable table;
  std::vector<Material>& all = *table.all_;
  const size_t errors_before = diagnostics.error_count();
  for (const Data& entry : *entries->list()) {
    const Data* name = entry.find("name");
    if (!name || !name->string() || name->string()->empty()) {
      diagnostics.error(entry.where, "every material needs a \"name\"");
      continue;
    }
    const auto r = channel(entry, "r", std::nullopt, diagnostics), g = channel(entry, "g", std::nullopt, diagnostics),
               b = channel(entry, "b", std::nullopt, diagnostics), a = channel(entry, "a", 255, diagnostics);
    if (!r || !g || !b || !a) continue;
    Material material{*name->string(), 0, {*r, *g, *b, *a}, {}};
    for (const auto& [key, value] : *entry.members())
      if (key != "name" && key != "r" && key != "g" && key != "b" && key != "a")
        material.properties.emplace_back(key, value);
    if (to_lower(material.name) == "void") {
      all[0].properties = material.properties;  // void keeps its id and colour
      continue;
    }
    if (table.find(material.name)) {
      diagnostics.error(name->where, "the material \"" + material.name + "\" is defined twice");
      continue;
    }
    if (all.size() > most_materials) {
      diagnostics.error(entry.where, "a file may define at most " + std::to_string(most_materials) + " materials");
      break;
    }
    material.id = static_cast<MaterialId>(all.size());
    if (is_marked_as_support(material.properties, diagnostics)) {
      if (table.support_ != 0)
        diagnostics.error(
            entry.where,
            "\"" + all[table.support_].name + "\" and \"" + material.name + "\" are both marked as support",
            "leave \"support\": true with one of them; support(material=...) takes the other");
      table.support_ = material.id;
    }
    all.push_back(std::move(material));
  }
  if (all.size() == 1 && diagnostics.error_count() == errors_before)
    diagnostics.error(entries->where, "this file defines no material");
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return table;
}

Data MaterialTable::to_data() const {
  DataList list;
  for (size_t i = 1; i < all_->size(); ++i) {
    const Material& m = (*all_)[i];
    DataMembers entry{{"name", Data(m.name)}};
    const char* keys[] = {"r", "g", "b", "a"};
    for (size_t c = 0; c < 4; ++c) entry.emplace_back(keys[c], Data(static_cast<double>(m.colour[c])));
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

const Material* MaterialTable::support() const { return support_ != 0 ? find(support_) : find("support"); }

std::vector<std::string> MaterialTable::names() const {
  std::vector<std::string> names;
  for (const Material& material : *all_) names.push_back(material.name);
  return names;
}

}  // namespace ombre::design
