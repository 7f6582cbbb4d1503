// Parameters that are points or fonts.
#include "design/values.h"

namespace ombre::design {
namespace {

bool is_point(const Data& data) {
  if (!data.list() || data.list()->size() < 2 || data.list()->size() > 3) return false;
  for (const Data& element : *data.list())
    if (!element.number()) return false;
  return true;
}

std::string point_number(size_t index) { return "point " + std::to_string(index + 1); }

bool read_point(const Data& data, const Domain& domain, size_t index, Points& value, const Reader& reader) {
  if (!is_point(data)) return reader.fail(data, "two or three numbers (mm) as " + point_number(index));
  const DataList& list = *data.list();
  const bool is_flat = list.size() == 2;
  if (index == 0) value.are_flat = is_flat;
  if (is_flat != value.are_flat)
    return reader.fail(data, std::string(value.are_flat ? "two" : "three") + " numbers as " + point_number(index) +
                                 ", as the first point has");
  Vec3& p = value.at.emplace_back();
  for (size_t axis = 0; axis < list.size(); ++axis)
    if (!read(list[axis], domain, p[static_cast<int>(axis)], reader)) return false;
  return true;
}

}  // namespace

bool read(const Data& data, const Domain& domain, Points& value, const Reader& reader) {
  value = {};
  if (!data.list() || is_point(data))
    return reader.fail(data, "a list of points", "write for example [[0, 0], [10, 0], [0, 10]]");
  value.at.reserve(data.list()->size());
  for (size_t n = 0; n < data.list()->size(); ++n)
    if (!read_point((*data.list())[n], domain, n, value, reader)) return false;
  return true;
}

bool read(const Data& data, const Domain& domain, std::vector<Points>& value, const Reader& reader) {
  value.clear();
  if (!data.list()) return reader.fail(data, "a list of lists of points");
  const bool is_one = !data.list()->empty() && is_point(data.list()->front());
  if (is_one) return read(data, domain, value.emplace_back(), reader);
  for (const Data& element : *data.list())
    if (!read(element, domain, value.emplace_back(), reader)) return false;
  return true;
}

bool read(const Data& data, const Domain&, FontName& value, const Reader& reader) {
  if (!data.string() || data.string()->empty()) return reader.fail(data, "the name of a font, or the path of its file");
  value.name = *data.string();
  return true;
}

Data write(const Points& value, bool) {
  DataList list;
  list.reserve(value.at.size());
  for (const Vec3& p : value.at)
    list.emplace_back(value.are_flat ? DataList{Data(p.x), Data(p.y)} : DataList{Data(p.x), Data(p.y), Data(p.z)});
  return Data(std::move(list));
}

Data write(const std::vector<Points>& value, bool for_hash) {
  DataList list;
  for (const Points& points : value) list.push_back(write(points, for_hash));
  return Data(std::move(list));
}

Data write(const FontName& value, bool for_hash) { return Data(for_hash ? value.content.hex() : value.name); }

}  // namespace ombre::design
