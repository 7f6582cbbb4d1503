#include "jobs/mesh/strut_frames.h"

#include "nodes/all_nodes.h"

namespace ombre::compile {

bool is_boolean(const design::Node& node) {
  const std::string& name = node.type().name;
  return name == "union" || name == "intersection" || name == "difference";
}

std::optional<InputFrame> input_frame(const design::Node& node) {
  if (const auto copies = nodes::tile_copies_of(node)) return InputFrame{{}, copies};
  if (node.keeps_shape() || is_boolean(node)) return InputFrame{};
  const auto map = here_from_input(node);
  return map ? std::optional(InputFrame{*map}) : std::nullopt;
}

std::optional<double> scale_of_similarity(const Affine& map) {
  const auto [least, greatest] = stretch(map);
  constexpr double rounding = 1e-9;
  return greatest - least <= rounding * greatest ? std::optional(greatest) : std::nullopt;
}

Box reach(const nodes::StrutShape& strut) {
  return hull(Box{strut.start, strut.start}.expanded(strut.start_radius),
              Box{strut.end, strut.end}.expanded(strut.end_radius));
}

Box reach(const std::vector<nodes::StrutShape>& struts) {
  Box box;
  for (const nodes::StrutShape& strut : struts) box = hull(box, reach(strut));
  return box;
}

design::NodePtr solid_of(const Data& held, const design::MaterialTable& materials, const SourceRange& where,
                         Diagnostics& diagnostics) {
  const design::NodeType& type = *nodes::registry().find("solid_of");
  return design::make_node(type, {{&type.parameters[0], held}}, {}, {materials, diagnostics, nullptr, where, "", ""});
}

}  // namespace ombre::compile
