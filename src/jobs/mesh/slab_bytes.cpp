#include "jobs/mesh/slab_bytes.h"

#include "base/system/byte_pack.h"

namespace ombre::jobs {
namespace {

using surface::CrossedEdge;

// A hidden edge without its leaves, which are not set.
struct PackedEdge {
  surface::CellPlace start{};
  surface::Label from = 0, to = 0;
  uint16_t axis = 0, level = 0;
};
static_assert(std::has_unique_object_representations_v<PackedEdge>);
static_assert(std::has_unique_object_representations_v<surface::MixedCell>);

std::vector<PackedEdge> packed(const std::vector<CrossedEdge>& edges) {
  std::vector<PackedEdge> all;
  for (const CrossedEdge& edge : edges) all.push_back({edge.start, edge.from, edge.to, edge.axis, edge.level});
  return all;
}

std::vector<CrossedEdge> unpacked(const std::vector<PackedEdge>& edges) {
  std::vector<CrossedEdge> all;
  for (const PackedEdge& edge : edges) {
    CrossedEdge made{edge.start, static_cast<uint8_t>(edge.axis), static_cast<uint8_t>(edge.level), edge.from, edge.to};
    made.leaves.fill(surface::CellTree::none);
    all.push_back(made);
  }
  return all;
}

}  // namespace

std::string slab_bytes(const surface::GridBorders& borders) {
  BytePacker packer;
  packer.add_list(borders.cells);
  packer.add_list(borders.crossings);
  packer.add(uint64_t{borders.hidden.size()});
  for (const std::vector<CrossedEdge>& strip : borders.hidden) packer.add_list(packed(strip));
  return packer.take();
}

surface::GridBorders read_slab(std::string_view bytes) {
  ByteUnpacker unpacker(bytes);
  surface::GridBorders borders;
  borders.cells = unpacker.get_list<surface::MixedCell>();
  borders.crossings = unpacker.get_list<surface::BorderPoint>();
  for (auto strips = unpacker.get<uint64_t>(); strips > 0; --strips)
    borders.hidden.push_back(unpacked(unpacker.get_list<PackedEdge>()));
  return borders;
}

}  // namespace ombre::jobs
