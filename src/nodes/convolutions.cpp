// Solids whose composition is that of the voxels around.
#include "design/spec.h"
#include "nodes/all_nodes.h"
#include "nodes/box_sum.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct VoxelBlend {
  Counts3 size{3, 3, 3};
  bool count_void = false;
  std::optional<Vec3> pitch;
  StagePtr sums;  // known when the node is made

  static Spec<VoxelBlend> spec() {
    return {
        "blend",
        "convolutions",
        "Gives each voxel of its child the mean composition of the voxels in a box around it; the shape stays.",
        {{"size", &VoxelBlend::size, "Voxels of the box along x, y and z", required(from_to(1, 1000))},
         {"count_void", &VoxelBlend::count_void,
          "Whether voxels outside of the child count as void; else only those inside count"},
         {"pitch", &VoxelBlend::pitch, "Size of the voxels; none: the job's", unit::positive_mm}},
        one_solid,
        "blend((10, 10, 1)) union() { translate(-3, 0, 0) cube(6, \"red\"); translate(3, 0, 0) cube(6, \"blue\"); }"};
  }

  bool complete(const Reader&, const std::vector<NodePtr>& inputs) {
    sums = make_box_sums(inputs[0], {size, count_void, pitch});
    return true;
  }

  // Where no voxel around is inside, as in what is thinner than a voxel, the child's own composition holds.
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    Composition own = in.composition(0, p, demand);
    const bool has_void = !own.fractions.empty() && own.fractions[0].first == void_material;
    if (count_void && !has_void) own.fractions.insert(own.fractions.begin(), {void_material, p.constant(0)});
    if (own.fractions.size() == 1) return own;
    const program::SourceField source = in.staged(sums);
    std::vector<Field> parts;
    for (const auto& [id, fraction] : own.fractions)
      parts.push_back(p.builder().source(source, source->channel(sum_channel(id)), p.x, p.y, p.z));
    const Field total = program::sum(parts), is_known = less(p.constant(0), total);
    for (size_t n = 0; n < parts.size(); ++n) {
      Field& fraction = own.fractions[n].second;
      fraction = select(is_known, share(parts[n], total), fraction);
    }
    return own;
  }
};

}  // namespace

void add_convolutions(Registry& registry) { registry.add<VoxelBlend>(); }

}  // namespace ombre::nodes
