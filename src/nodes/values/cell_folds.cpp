#include "nodes/values/cell_folds.h"

#include "base/text/text.h"

namespace ombre::nodes {

std::optional<Vec3> find_folded_cell(const design::Reader& reader, const std::vector<design::NodePtr>& roots,
                                     const Box& box, int side, const FieldAt& outside, const FieldAt& determinant) {
  const auto made = [&](const FieldAt& field) {
    return MadeFields(reader, roots, box, [&](design::Lowering& lowering, const program::Point& p) {
      return std::vector{field(lowering, p)};
    });
  };
  const MadeFields region = made(outside);
  std::optional<MadeFields> turns;  // made for the first point in the region
  std::vector<double> values;
  std::optional<double> first;
  return find_tested_point(box, side, [&](Vec3 at) {
    if (region.at(at, values)[0] > 0) return false;
    if (!turns) turns.emplace(made(determinant));
    const double turn = turns->at(at, values)[0];
    if (!first) first = turn;
    return !(turn * *first > 0);
  });
}

bool refuse_folded(const design::Reader& reader, Vec3 at, const std::string& hint) {
  return reader.refuse("cells of " + std::string(reader.node) + " are folded or have no volume at (" +
                           format_rounded(at.x) + ", " + format_rounded(at.y) + ", " + format_rounded(at.z) + ")",
                       hint);
}

}  // namespace ombre::nodes
