// Vectors, matrices, points and edges as parameters.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "design/ports/lists.h"

namespace ombre::design {

// A strut of a lattice; lengths in mm.
struct Edge {
  Vec3 start, end;
  double radius = 0;  // 0 for the lattice's radius
  bool operator==(const Edge&) const = default;
};

// A list of points, all given by three numbers, or all by two with z = 0.
struct Points {
  std::vector<Vec3> at;
  bool are_flat = false;  // given by two numbers
  bool operator==(const Points&) const = default;
};

// Returns false and adds a diagnostic if the data is not a list of three.
bool read_vector(const Data& data, const Domain& domain, const Reader& reader);

template <>
struct Port<Vec3> {
  static PortText text(const Domain&) { return {"3 numbers", "triples of numbers", "Numbers"}; }
  static bool read(const Data& data, const Domain& domain, Vec3& value, const Reader& reader);
  static Data write(const Vec3& value, bool for_hash);
};

template <>
struct Port<Affine> {
  static PortText text(const Domain&) { return {"matrix", "matrices", "ArrayLike"}; }
  static bool read(const Data& data, const Domain& domain, Affine& value, const Reader& reader);
  static Data write(const Affine& value, bool for_hash);
};

template <>
struct Port<Edge> {
  static PortText text(const Domain&) { return {"edge", "edges", "Sequence[Any]"}; }
  static bool read(const Data& data, const Domain& domain, Edge& value, const Reader& reader);
  static Data write(const Edge& value, bool for_hash);
};

template <>
struct Port<Points> {
  static PortText text(const Domain&) { return {"list of points", "lists of points", "ArrayLike"}; }
  static bool read(const Data& data, const Domain& domain, Points& value, const Reader& reader);
  static Data write(const Points& value, bool for_hash);
  static bool is_one(const Data& data);
};

}  // namespace ombre::design
