#include "design/ports/material_names.h"

#include <cmath>

#include "base/text/text.h"
#include "design/outputs.h"

namespace ombre::design {

bool Port<MaterialName>::read(const Data& data, const Domain& domain, MaterialName& value, const Reader& reader) {
  value = {};
  if (is_value(data)) {
    if (!domain.may_mix)
      return reader.fail(data, "a material's name",
                         "one material is meant here; values mix several by " +
                             spelled::around("fgrade", {{"", "[1 - t, t]"}, {"", "[red, blue]"}}));
    const auto mixture = read_mixture(data, reader);
    if (mixture) value.mixture = *mixture;
    return mixture.has_value();
  }
  if (const double* id = data.number()) {
    const bool is_id = *id >= 0 && *id <= 255 && *id == std::floor(*id);
    const Material* material = is_id ? reader.materials.find(static_cast<MaterialId>(*id)) : nullptr;
    if (!material)
      return reader.fail(
          data, "a material's name, or its number from 0 to " + std::to_string(reader.materials.all().size() - 1));
    value.material = material;
    return true;
  }
  if (!data.string()) return reader.fail(data, "a material's name");
  if (data.string()->empty()) {
    value.material = &reader.materials.first();
    return true;
  }
  if (const Material* material = reader.materials.find(*data.string())) {
    value.material = material;
    return true;
  }
  const auto names = reader.materials.names();
  std::string hint = did_you_mean(*data.string(), names);
  if (hint.empty()) hint = "there are " + join(names, ", ");
  reader.diagnostics.error(
      Code::unknown_material, data.where.source ? data.where : reader.where,
      "there is no material \"" + *data.string() + "\"", hint,
      {{"material", *data.string()}, {"similar", closest_name(*data.string(), names).value_or("")}});
  return false;
}

// A text is a material if there is one of that name, else an expression.
bool Port<NumberOrMaterial>::read(const Data& data, const Domain& domain, NumberOrMaterial& value,
                                  const Reader& reader) {
  value = {};
  const bool is_name = data.string() && reader.materials.find(*data.string());
  if (!is_name && !is_mixture(data)) return design::read(data, domain, value.number, reader);
  Domain of_material;
  of_material.may_mix = true;
  return design::read(data, of_material, value.material, reader);
}

Data Port<MaterialName>::write(const MaterialName& value, bool) {
  if (value.mixture.node) return write_output(value.mixture);
  return Data(value.material ? value.material->name : std::string());
}
Data Port<NumberOrMaterial>::write(const NumberOrMaterial& value, bool for_hash) {
  return value.material.is_given() ? design::write(value.material, for_hash) : design::write(value.number, for_hash);
}

bool Port<MaterialForName>::read(const Data& data, const Domain& domain, MaterialForName& value, const Reader& reader) {
  if (!data.list() || data.list()->size() != 2 || !data.list()->front().string())
    return reader.fail(data, "pairs of a name in the file and a material", "write for example [[\"PLA\", \"red\"]]");
  value.name = *data.list()->front().string();
  return design::read(data.list()->back(), domain, value.material, reader);
}

Data Port<MaterialForName>::write(const MaterialForName& value, bool for_hash) {
  return Data(DataList{Data(value.name), design::write(value.material, for_hash)});
}

bool Port<MaterialStop>::read(const Data& data, const Domain& domain, MaterialStop& value, const Reader& reader) {
  if (!data.list() || data.list()->size() != 2 || !data.list()->front().number())
    return reader.fail(data, "pairs of a number and a material", "write for example [[0, \"clear\"], [100, \"red\"]]");
  return design::read(data.list()->front(), unit::none, value.at, reader) &&
         design::read(data.list()->back(), domain, value.material, reader);
}

Data Port<MaterialStop>::write(const MaterialStop& value, bool for_hash) {
  return Data(DataList{Data(value.at), design::write(value.material, for_hash)});
}

}  // namespace ombre::design
