#include "stages/stage_hash.h"

#include "base/text/text.h"
#include "design/design.h"

namespace ombre::compile {
namespace {

std::string text_of(Vec3 v) { return format_number(v.x) + ' ' + format_number(v.y) + ' ' + format_number(v.z) + ' '; }

std::string text_of(const design::StageRead& read, const design::MaterialTable& materials) {
  design::Design design;
  design.materials = materials;
  design::NodePtr solid = read.solid;
  const bool is_shape = !read.fractions && read.attributes.empty();
  while (is_shape && solid->keeps_shape()) solid = solid->inputs()[0];
  design.parts = {{"", solid}};
  std::string text = design::hash(design).hex();
  for (const bool what : {read.inside, read.distance, read.fractions}) text += what ? '1' : '0';
  for (const std::string& attribute : read.attributes) text += '\t' + attribute;
  return text + '\n';
}

}  // namespace

Hash hash_of_values(const LatticeFrame& frame) {
  std::string text = "values of " + frame.stage->name() + ' ' + frame.stage->content().hex() + ' ';
  text += text_of(frame.lattice.origin) + text_of(frame.lattice.voxel_mm()) + text_of(frame.box.lo);
  text += text_of(frame.box.hi);
  for (const auto& end : {frame.cells.lo, frame.cells.hi})
    for (const int64_t cell : end) text += std::to_string(cell) + ' ';
  for (const design::StageRead& read : frame.stage->reads()) text += '\n' + text_of(read, frame.materials);
  return hash_bytes(text);
}

}  // namespace ombre::compile
