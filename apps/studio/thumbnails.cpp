// Small pictures of the nodes of a design. They are kept as long as there is room, by the hash of the node and of all
// below it, so that an edit makes only those again whose nodes it changed.
#include "compile/picture.h"
#include "formats/png.h"
#include "studio/design_answer.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

constexpr int64_t most_side = 256;  // pixels
constexpr double most_seconds = 2;  // that one may take: others wait
constexpr const char* view = "iso";

// The node as a design of its own. The nodes of the whole design live as long as it.
compile::Loaded alone(const compile::Loaded& loaded, const design::Node& node) {
  design::Design design;
  design.materials = loaded.design.materials;
  design.parts = {{"", design::NodePtr(std::shared_ptr<const design::Node>(), &node)}};
  return {loaded.path, loaded.source, std::move(design)};
}

const design::Node& node_of(const OpenDesign& design, const Request& request) {
  const std::vector<const design::Node*> nodes = listed_nodes(design.loaded->design);
  const design::Node& node =
      *nodes[static_cast<size_t>(request.whole("node", 0, static_cast<int64_t>(nodes.size()) - 1))];
  if (!node.type().is_solid()) throw RequestError("unsupported", node.type().name + " is no solid");
  if (node.uses_cell()) throw RequestError("unsupported", node.type().name + " depends on the cell that repeats it");
  return node;
}

std::string made_now(const compile::Loaded& loaded, const compile::PictureRequest& picture, const StopFlag& stop) {
  std::string png;
  Diagnostics diagnostics;
  const auto take = [&](int, const compile::Picture& made) {
    png = formats::encode_png(static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height), made.rgba);
  };
  if (!compile::take_pictures(loaded, picture, stop, take, diagnostics) || diagnostics.has_errors())
    throw design_error(diagnostics);
  return png;
}

}  // namespace

Answer thumbnail_answer(OpenDesign& design, const Request& request, const StopFlag& cancelled) {
  const compile::Loaded loaded = alone(*design.loaded, node_of(design, request));
  compile::PictureRequest picture;
  picture.width = request.whole("width", 1, most_side);
  picture.height = request.whole("height", 1, most_side);
  picture.samples = 1;
  picture.view = *render::named_view(view);
  picture.background.is_transparent = true;
  picture.memory = &design.memory;
  const Hash key = hash_bytes("thumbnail " + design::hash(loaded.design).hex() + ' ' + std::to_string(picture.width) +
                              ' ' + std::to_string(picture.height));
  if (const auto known = design.memory.find(key)) return {{}, *std::static_pointer_cast<const std::string>(known)};
  const StopFlag stop(&cancelled, most_seconds);
  const auto png = std::make_shared<const std::string>(made_now(loaded, picture, stop));
  if (stop.requested()) throw Cancelled();
  design.memory.keep(key, png, png->size());
  return {{}, *png};
}

}  // namespace ombre::studio
