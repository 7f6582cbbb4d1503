#include "design/ports/places.h"

#include "base/text/text.h"

namespace ombre::design {
namespace {

bool is_list(const Data& data, size_t size) { return data.list() && data.list()->size() == size; }

}  // namespace

bool read_vector(const Data& data, const Domain& domain, const Reader& reader) {
  return is_list(data, 3) || reader.fail(data, "three numbers (x, y, z)" + unit_text(domain));
}

bool Port<Vec3>::read(const Data& data, const Domain& domain, Vec3& value, const Reader& reader) {
  if (!read_vector(data, domain, reader)) return false;
  const DataList& list = *data.list();
  const bool x = design::read(list[0], domain, value.x, reader), y = design::read(list[1], domain, value.y, reader),
             z = design::read(list[2], domain, value.z, reader);
  return x && y && z;
}

Data Port<Vec3>::write(const Vec3& v, bool) { return Data(DataList{Data(v.x), Data(v.y), Data(v.z)}); }

bool Port<Affine>::read(const Data& data, const Domain& domain, Affine& value, const Reader& reader) {
  const std::string expected = "a matrix of 3 or 4 rows with 4 numbers each";
  const DataList* rows = data.list();
  if (!rows || rows->size() < 3 || rows->size() > 4) return reader.fail(data, expected);
  for (size_t r = 0; r < rows->size(); ++r) {
    if (!is_list((*rows)[r], 4)) return reader.fail((*rows)[r], expected);
    for (size_t c = 0; c < 4; ++c) {
      double number = 0;
      if (!design::read((*(*rows)[r].list())[c], domain, number, reader)) return false;
      if (r == 3) {
        if (number != (c == 3 ? 1 : 0)) return reader.fail((*rows)[3], "0, 0, 0, 1 as the last row");
      } else if (c == 3) {
        value.offset[static_cast<int>(r)] = number;
      } else {
        value.rows[r][static_cast<int>(c)] = number;
      }
    }
  }
  return true;
}

Data Port<Affine>::write(const Affine& value, bool) {
  DataList rows;
  for (int r = 0; r < 3; ++r) {
    const Vec3& row = value.rows[static_cast<size_t>(r)];
    rows.emplace_back(DataList{Data(row.x), Data(row.y), Data(row.z), Data(value.offset[r])});
  }
  return Data(std::move(rows));
}

bool Port<Edge>::read(const Data& data, const Domain& domain, Edge& value, const Reader& reader) {
  const DataList* parts = data.list();
  if (!parts || parts->size() < 2 || parts->size() > 3)
    return reader.fail(
        data, "edges of two points (mm), each with a radius if it has its own",
        "write for example " + spelled::value("[[(0, 0, 0), (10, 0, 0)], [(0, 0, 0), (0, 10, 0), 0.5]]"));
  if (!design::read((*parts)[0], domain, value.start, reader) || !design::read((*parts)[1], domain, value.end, reader))
    return false;
  if (value.start == value.end) return reader.fail(data, "edges with two different ends");
  if (parts->size() == 2) return true;
  return design::read((*parts)[2], unit::positive_mm, value.radius, reader);
}

Data Port<Edge>::write(const Edge& value, bool h) {
  DataList parts{design::write(value.start, h), design::write(value.end, h)};
  if (value.radius > 0) parts.emplace_back(value.radius);
  return Data(std::move(parts));
}

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
    if (!design::read(list[axis], domain, p[static_cast<int>(axis)], reader)) return false;
  return true;
}

}  // namespace

bool Port<Points>::read(const Data& data, const Domain& domain, Points& value, const Reader& reader) {
  value = {};
  if (!data.list() || is_point(data))
    return reader.fail(data, "a list of points", "write for example [[0, 0], [10, 0], [0, 10]]");
  value.at.reserve(data.list()->size());
  for (size_t n = 0; n < data.list()->size(); ++n)
    if (!read_point((*data.list())[n], domain, n, value, reader)) return false;
  return true;
}

bool Port<Points>::is_one(const Data& data) {
  return data.list() && !data.list()->empty() && is_point(data.list()->front());
}

Data Port<Points>::write(const Points& value, bool) {
  DataList list;
  list.reserve(value.at.size());
  for (const Vec3& p : value.at)
    list.emplace_back(value.are_flat ? DataList{Data(p.x), Data(p.y)} : DataList{Data(p.x), Data(p.y), Data(p.z)});
  return Data(std::move(list));
}

}  // namespace ombre::design
