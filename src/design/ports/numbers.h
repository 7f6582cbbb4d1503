// Numbers as parameters, constant or varying in space.
#pragma once

#include <array>
#include <map>
#include <string_view>
#include <variant>

#include "base/math/interval.h"
#include "design/lowered.h"
#include "design/ports/port.h"
#include "expr/expression.h"

namespace ombre::design {

// A constant, or a field over space given by an expression, which may contain outputs of nodes.
class Number {
 public:
  Number(double value = 0) : value_(value) {}           // NOLINT: implicit conversion from double
  Number(expr::Expression e) : value_(std::move(e)) {}  // NOLINT: implicit conversion from an expression
  program::Field operator()(const program::Point& p) const { return at(p, nullptr); }
  // Evaluates with variables besides the coordinates.
  program::Field at(const program::Point& p, const expr::Variables& extra) const;
  // Returns an interval that encloses its values in `where`, given the ranges of variables besides the coordinates.
  Interval range(const Box& where, const std::map<std::string_view, Interval>& extra = {}) const;
  bool uses_cell() const;  // true if it uses ci, cj or ck
  const double* constant() const { return std::get_if<double>(&value_); }
  const expr::Expression* expression() const { return std::get_if<expr::Expression>(&value_); }
  bool operator==(const Number&) const = default;

 private:
  std::variant<double, expr::Expression> value_;
};

struct Numbers3 {
  Number x, y, z;
  Vec3 upper(const Box& where) const { return {x.range(where).hi, y.range(where).hi, z.range(where).hi}; }
  bool operator==(const Numbers3&) const = default;
};

// Numbers of items along x, y and z.
using Counts3 = std::array<int, 3>;

template <>
struct Port<double> {
  static PortText text(const Domain&) { return {"number", "numbers", "float", "number"}; }
  static bool read(const Data& data, const Domain& domain, double& value, const Reader& reader);
  static Data write(const double& value, bool for_hash);
};

template <>
struct Port<int> {
  static PortText text(const Domain&) { return {"whole number", "whole numbers", "int", "number"}; }
  static bool read(const Data& data, const Domain& domain, int& value, const Reader& reader);
  static Data write(const int& value, bool for_hash);
};

template <>
struct Port<Counts3> {
  static PortText text(const Domain&) { return {"3 whole numbers", "triples of whole numbers", "Sequence[int]"}; }
  static bool read(const Data& data, const Domain& domain, Counts3& value, const Reader& reader);
  static Data write(const Counts3& value, bool for_hash);
};

template <>
struct Port<Number> {
  static PortText text(const Domain&) { return {"number or field", "numbers or fields", "Number"}; }
  static bool read(const Data& data, const Domain& domain, Number& value, const Reader& reader);
  static Data write(const Number& value, bool for_hash);
  static bool is_constant(const Number& value) { return value.constant() != nullptr; }
  static bool uses_cell(const Number& value) { return value.uses_cell(); }
};

template <>
struct Port<Numbers3> {
  static PortText text(const Domain& domain);
  static bool read(const Data& data, const Domain& domain, Numbers3& value, const Reader& reader);
  static Data write(const Numbers3& value, bool for_hash);
  static bool is_constant(const Numbers3& n) { return n.x.constant() && n.y.constant() && n.z.constant(); }
  static bool uses_cell(const Numbers3& n) { return n.x.uses_cell() || n.y.uses_cell() || n.z.uses_cell(); }
};

}  // namespace ombre::design
