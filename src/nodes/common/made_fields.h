// Fields that are evaluated while a node is made.
#pragma once

#include <functional>
#include <vector>

#include "design/lowering.h"
#include "design/ports/numbers.h"
#include "design/ports/solid_name.h"
#include "program/program.h"

namespace ombre::nodes {

// Adds the nodes whose outputs a number uses.
void add_nodes_of(const design::Number& number, std::vector<design::NodePtr>& roots);
// Returns g of a solid or region.
program::Field outside_of(design::Lowering& lowering, const design::SolidName& solid, const program::Point& p);
// Returns a box around the points of `where` at which g of a solid or region is at most `margin`: by default the
// inside.
Box box_of(const design::SolidName& solid, const Box& where, double margin = 0);

// The program of some fields, for points in a box. Thread-safe.
class MadeFields {
 public:
  using Make = std::function<std::vector<program::Field>(design::Lowering& lowering, const program::Point& p)>;
  // `roots` are the nodes that the fields use.
  MadeFields(const design::Reader& reader, const std::vector<design::NodePtr>& roots, const Box& box, const Make& make);

  // Returns the value of each field. `values` is memory for the evaluation, which several calls may use.
  std::vector<double> at(Vec3 p, std::vector<double>& values) const;
  std::vector<double> at(Vec3 p) const;
  // Returns an interval for each field that encloses its values in a box.
  std::vector<Interval> range(const Box& box) const;

 private:
  program::Program program_;
};

}  // namespace ombre::nodes
