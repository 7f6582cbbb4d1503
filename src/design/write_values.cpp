// Writes values of parameters as plain data.
#include "design/outputs.h"
#include "design/values.h"

namespace ombre::design {

Data write(double value, bool) { return Data(value); }
Data write(const std::optional<double>& value, bool) { return value ? Data(*value) : Data(); }
Data write(const Number& value, bool for_hash) {
  if (const double* number = value.constant()) return Data(*number);
  if (const auto& source = value.expression()->source(); source && !for_hash) return Data(HostObjectPtr(source));
  if (!value.expression()->inputs().empty()) return write_formula(*value.expression());
  return Data(value.expression()->text());
}
Data write(const Numbers3& v, bool h) { return Data(DataList{write(v.x, h), write(v.y, h), write(v.z, h)}); }
Data write(bool value, bool) { return Data(value); }
Data write(const std::string& value, bool) { return Data(value); }
Data write(Choice value, bool) { return Data(std::string(value.text())); }
Data write(const Vec3& v, bool) { return Data(DataList{Data(v.x), Data(v.y), Data(v.z)}); }
Data write(const std::optional<Vec3>& value, bool h) { return value ? write(*value, h) : Data(); }
Data write(const Affine& value, bool) {
  DataList rows;
  for (int r = 0; r < 3; ++r) {
    const Vec3& row = value.rows[static_cast<size_t>(r)];
    rows.emplace_back(DataList{Data(row.x), Data(row.y), Data(row.z), Data(value.offset[r])});
  }
  return Data(std::move(rows));
}
Data write(const MaterialName& value, bool) {
  if (value.mixture) return write_mixture(*value.mixture);
  return Data(value.material ? value.material->name : std::string());
}
Data write(const NumberOrMaterial& value, bool for_hash) {
  return value.material.is_given() ? write(value.material, for_hash) : write(value.number, for_hash);
}
Data write(const FilePath& value, bool for_hash) { return Data(for_hash ? value.content.hex() : value.path); }
Data write(const SharedList<Number>& value, bool h) {
  DataList list;
  for (const Number& element : value) list.push_back(write(element, h));
  return Data(std::move(list));
}
Data write(const SharedList<MaterialName>& value, bool h) {
  DataList list;
  for (const MaterialName& element : value) list.push_back(write(element, h));
  return Data(std::move(list));
}

Data write(const std::optional<std::vector<Edge>>& value, bool h) {
  if (!value) return {};
  DataList list;
  for (const Edge& edge : *value) {
    DataList parts{write(edge.start, h), write(edge.end, h)};
    if (edge.radius > 0) parts.emplace_back(edge.radius);
    list.emplace_back(std::move(parts));
  }
  return Data(std::move(list));
}

Data write(const std::vector<MaterialStop>& value, bool h) {
  DataList list;
  for (const auto& [at, material] : value) list.emplace_back(DataList{Data(at), write(material, h)});
  return Data(std::move(list));
}

Data write(const std::vector<MaterialForName>& value, bool h) {
  DataList list;
  for (const auto& [name, material] : value) list.emplace_back(DataList{Data(name), write(material, h)});
  return Data(std::move(list));
}

}  // namespace ombre::design
