// Solids whose composition, attributes or surface are computed from the surrounding voxels.
#include <algorithm>

#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/filter_stages.h"
#include "nodes/common/shapes.h"
#include "nodes/common/stage_fields.h"
#include "nodes/common/whole_stages.h"
#include "nodes/stages/box_sum.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Returns the shares of the filtered materials; negative ones count as 0. Where no share is left, as in features
// thinner than a voxel, returns the child's own composition.
Composition filtered_composition(const Inputs& in, const Point& p, Demand demand, const StagePtr& stage,
                                 bool count_void) {
  Composition own = in.composition(0, p, demand);
  const bool has_void = !own.fractions.empty() && own.fractions[0].first == void_material;
  if (count_void && !has_void) own.fractions.insert(own.fractions.begin(), {void_material, p.constant(0)});
  if (own.fractions.size() == 1) return own;
  std::vector<Field> parts;
  for (const auto& [id, fraction] : own.fractions)
    parts.push_back(max(read_channel(in, stage, sum_channel(id), p), 0.0));
  const Field total = program::sum(parts), is_known = less(p.constant(0), total);
  for (size_t n = 0; n < parts.size(); ++n) {
    Field& fraction = own.fractions[n].second;
    fraction = select(is_known, share(parts[n], total), fraction);
  }
  return own;
}

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns the child's own attribute if it is none of the filtered ones.
Field filtered_attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand, const StagePtr& stage,
                         const std::vector<std::string>& filtered) {
  const Field own = in.attribute(0, name, p, demand);
  if (!holds(filtered, name)) return own;
  const Field weight = read_channel(in, stage, "share", p);
  return select(less(p.constant(0), weight), read_channel(in, stage, "attribute " + std::string(name), p) / weight,
                own);
}

// Returns false and adds a diagnostic if the child does not have one of the attributes.
bool check_attributes(const Reader& reader, const NodePtr& child, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Node* node : topological({child}))
    if (const auto declared = node->declares()) known.push_back(declared->name);
  for (const std::string& name : names) {
    if (holds(known, name)) continue;
    return reader.refuse("the child of " + std::string(reader.node) + " has no attribute \"" + name + '"',
                         known.empty() ? "it has none" : "it has " + join(known, ", "));
  }
  return true;
}

constexpr const char* about_attributes = "Names of attributes that are filtered, too";
constexpr const char* about_void = "Counts voxels outside the child as void; else only voxels inside count";

// A filter of compositions whose sums are made by a stage.
struct Filter {
  bool count_void = false;
  std::optional<Vec3> pitch;
  StagePtr stage;  // set when the node is made

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return filtered_composition(in, p, demand, stage, count_void);
  }
};

struct AttributeFilter : Filter {
  std::vector<std::string> attributes;

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    return filtered_attribute(in, name, p, demand, stage, attributes);
  }
};

struct VoxelBlend : Filter {
  Counts3 size{3, 3, 3};

  static Spec<VoxelBlend> spec() {
    return {
        "blend",
        "Gives each voxel of its child the mean composition of the voxels in a box around it. The shape does not "
        "change.",
        {{"size", &VoxelBlend::size, "Number of voxels of the box along x, y and z", required(from_to(1, 1000))},
         {"count_void", &VoxelBlend::count_void, about_void},
         {"pitch", &VoxelBlend::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "blend((10, 10, 1)) union() { translate(-3, 0, 0) cube(6, \"red\"); translate(3, 0, 0) cube(6, \"blue\"); }"};
  }

  bool complete(const Reader&, const std::vector<NodePtr>& inputs) {
    stage = make_box_sums(inputs[0], {size, count_void, pitch});
    return true;
  }
};

struct Convolve : AttributeFilter {
  Kernel kernel;

  static Spec<Convolve> spec() {
    return {
        "convolve",
        "Gives each voxel of its child the weighted mean of the compositions around it. The shape does not change.",
        {{"kernel", &Convolve::kernel,
          "Weights as lists along x of lists along y of lists along z; of n weights, number floor(n / 2) belongs to "
          "the voxel itself",
          required()},
         {"count_void", &Convolve::count_void, about_void},
         {"attributes", &Convolve::attributes, about_attributes},
         {"pitch", &Convolve::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "convolve([[[1]], [[2]], [[1]]]) union() { translate(-3, 0, 0) cube(6, \"red\"); translate(3, 0, 0) cube(6, "
        "\"blue\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!check_attributes(reader, inputs[0], attributes)) return false;
    std::string key = "convolve";
    for (const int n : kernel.size) key += ' ' + std::to_string(n);
    for (const double weight : kernel.weights) key += ' ' + format_number(weight);
    const FilterUse use{true, count_void, attributes, pitch};
    stage = make_linear_stage(inputs[0], use, key, [filter = LinearFilter::of(kernel)](Vec3) { return filter; });
    return true;
  }
};

// The width of a Gaussian: in mm along all axes, or in voxels along each.
struct Width {
  double mm = 0;
  std::optional<Vec3> voxels;

  Vec3 in_cells(Vec3 cell_mm) const { return voxels ? *voxels : Vec3{mm / cell_mm.x, mm / cell_mm.y, mm / cell_mm.z}; }
  std::string key() const {
    return voxels
               ? "voxels " + format_number(voxels->x) + ' ' + format_number(voxels->y) + ' ' + format_number(voxels->z)
               : "mm " + format_number(mm);
  }
};

constexpr const char* about_sigma = "Standard deviation of the weights, which extend to four times as far";
constexpr const char* about_sigma_voxels = "Standard deviation in voxels along x, y and z, in place of sigma";

// Returns false and adds a diagnostic unless exactly one of the two is given.
bool check_width(const Reader& reader, double sigma, const std::optional<Vec3>& voxels) {
  const bool has_voxels = voxels && voxels->x + voxels->y + voxels->z > 0;
  if ((sigma > 0) != has_voxels) return true;
  return reader.refuse(std::string(reader.node) + " needs either sigma or sigma_voxels, more than 0",
                       "write for example " + spelled::parameter("sigma", "0.5") + ", in mm");
}

LinearFilter gaussian_in(const Width& width, Vec3 cell_mm) { return LinearFilter::gaussian(width.in_cells(cell_mm)); }

struct Gaussian : AttributeFilter {
  double sigma = 0;
  std::optional<Vec3> sigma_voxels;

  static Spec<Gaussian> spec() {
    return {"gaussian",
            "Blurs its child's composition with weights of a normal distribution. The shape does not change.",
            {{"sigma", &Gaussian::sigma, about_sigma, unit::not_negative_mm},
             {"sigma_voxels", &Gaussian::sigma_voxels, about_sigma_voxels, from_to(0, 200)},
             {"count_void", &Gaussian::count_void, about_void},
             {"attributes", &Gaussian::attributes, about_attributes},
             {"pitch", &Gaussian::pitch, about_pitch, unit::positive_mm}},
            one_solid,
            "gaussian(0.8) union() { translate(-3, 0, 0) cube(6, \"red\"); translate(3, 0, 0) cube(6, \"blue\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!check_width(reader, sigma, sigma_voxels) || !check_attributes(reader, inputs[0], attributes)) return false;
    const Width width{sigma, sigma_voxels};
    stage = make_linear_stage(inputs[0], {true, count_void, attributes, pitch}, "gaussian " + width.key(),
                              [width](Vec3 cell_mm) { return gaussian_in(width, cell_mm); });
    return true;
  }
};

struct Sharpen {
  double amount = 1, sigma = 0;
  std::optional<Vec3> sigma_voxels, pitch;
  StagePtr stage;

  static Spec<Sharpen> spec() {
    return {
        "sharpen",
        "Makes borders between its child's materials steeper, by unsharp masking. The shape does not change.",
        {{"amount", &Sharpen::amount, "Factor of the difference from a Gaussian blur, which is added", positive("")},
         {"sigma", &Sharpen::sigma, about_sigma, unit::not_negative_mm},
         {"sigma_voxels", &Sharpen::sigma_voxels, about_sigma_voxels, from_to(0, 200)},
         {"pitch", &Sharpen::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "sharpen(2, sigma=0.5) fgrade([\"0.5 + x/10\", \"0.5 - x/10\"], [\"red\", \"blue\"]) cube(10);"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!check_width(reader, sigma, sigma_voxels)) return false;
    const Width width{sigma, sigma_voxels};
    const FilterUse use{true, false, {}, pitch};
    stage = make_linear_stage(inputs[0], use, "sharpen " + format_number(amount) + ' ' + width.key(),
                              [width, by = amount](Vec3 cell_mm) { return gaussian_in(width, cell_mm).sharpened(by); });
    return true;
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return filtered_composition(in, p, demand, stage, false);
  }
};

struct Majority : Filter {
  Counts3 size{3, 3, 3};

  static Spec<Majority> spec() {
    return {
        "majority",
        "Gives each voxel of its child the most frequent material in the box around it. The shape does not change.",
        {{"size", &Majority::size, "Number of voxels of the box along x, y and z", from_to(1, 99)},
         {"count_void", &Majority::count_void, about_void},
         {"pitch", &Majority::pitch, about_pitch, unit::positive_mm}},
        one_solid,
        "majority((5, 5, 5)) union() { translate(-3, 0, 0) cube(6, \"red\"); translate(3, 0, 0) cube(6, \"blue\"); }"};
  }

  bool complete(const Reader&, const std::vector<NodePtr>& inputs) {
    stage = make_majority_stage(inputs[0], {true, count_void, {}, pitch}, size);
    return true;
  }
};

struct Median {
  std::vector<std::string> attributes;
  Counts3 size{3, 3, 3};
  std::optional<Vec3> pitch;
  StagePtr stage;

  static Spec<Median> spec() {
    return {"median",
            "Gives each voxel of its child the median of attributes in the box around it. The shape does not change.",
            {{"attributes", &Median::attributes, "Names of the attributes", required()},
             {"size", &Median::size, "Number of voxels of the box along x, y and z", from_to(1, 99)},
             {"pitch", &Median::pitch, about_pitch, unit::positive_mm}},
            one_solid,
            "median([\"infill\"]) attribute(\"infill\", \"x > 0\") cube(10);"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!check_attributes(reader, inputs[0], attributes)) return false;
    stage = make_median_stage(inputs[0], {false, false, attributes, pitch}, size);
    return true;
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    return filtered_attribute(in, name, p, demand, stage, attributes);
  }
};

struct Smooth {
  double sigma = 0;
  bool keep_volume = false;
  std::optional<Vec3> sigma_voxels, pitch;
  StagePtr stage;

  static Spec<Smooth> spec() {
    return {"smooth",
            "Smooths the surface of its child: a point is inside if at least half of a Gaussian around it is inside "
            "the child.",
            {{"sigma", &Smooth::sigma, about_sigma, unit::not_negative_mm},
             {"sigma_voxels", &Smooth::sigma_voxels, about_sigma_voxels, from_to(0, 200)},
             {"pitch", &Smooth::pitch, about_pitch, unit::positive_mm},
             {"keep_volume", &Smooth::keep_volume,
              "Keeps the child's volume by choosing another share than half of the Gaussian"}},
            one_solid,
            "smooth(1) rectprism((10, 6, 4), \"red\");"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!check_width(reader, sigma, sigma_voxels)) return false;
    const Width width{sigma, sigma_voxels};
    const auto filter = [width](Vec3 cell_mm) { return gaussian_in(width, cell_mm); };
    if (keep_volume) return make_kept(reader, inputs[0], width, filter);
    stage = make_linear_stage(inputs[0], {false, false, {}, pitch}, "smooth " + width.key(), filter);
    return true;
  }

  Metric metric() const { return Metric::implicit(); }
  // Half of the Gaussian lies beyond a flat side, so nothing extends beyond the child's box at a level of 1/2 or more.
  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box box = stage->bounds();
    return box.is_empty() ? box : intersect(box.expanded(margin), where);
  }
  Field distance(const Inputs& in, const Point& p) const {
    const Box box = stage->bounds();
    if (box.is_empty()) return p.constant(Box::inf);
    const Vec3 c = box.center(), h = 0.5 * box.size();
    const Field from_box = corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
    const Field rest = 0.5 - read_channel(in, stage, "share", p);
    return select(from_box <= 0, rest, max(rest, from_box));
  }
  Composition composition(const Inputs& in, const Point& p, Demand) const {
    return in.composition(0, p, Demand::everywhere);
  }

 private:
  bool make_kept(const Reader& reader, const NodePtr& child, const Width& width,
                 const std::function<LinearFilter(Vec3)>& filter) {
    if (width.voxels && !pitch)
      return reader.refuse("keep_volume needs to know how wide the Gaussian is in mm",
                           "write for example " + spelled::parameter("sigma", "0.5") + " in place of sigma_voxels");
    // Sides move outward by less than a sigma, to compensate for the volume that corners and edges lose.
    const Vec3 voxels = width.voxels.value_or(Vec3{});
    const double widest =
        width.voxels ? std::max({voxels.x * pitch->x, voxels.y * pitch->y, voxels.z * pitch->z}) : width.mm;
    stage = make_kept_volume_stage(child, {widest, pitch}, width.key(), filter);
    return is_bounded(reader, stage);
  }
};

template <Morphology what>
struct Morphed : StagedSolid {
  double radius = 0;
  std::optional<Vec3> pitch;

  static Spec<Morphed> spec() {
    struct Words {
      std::string_view name, sentence, example;
    };
    static constexpr Words words[] = {
        {"dilate", "Adds all voxels within a radius of its child.", "dilate(1) cube(6, \"red\");"},
        {"erode", "Removes all voxels of its child within a radius of the outside.", "erode(1) cube(6, \"red\");"},
        {"opening", "Removes the parts of its child that a ball inside it cannot reach: spikes and thin walls.",
         "opening(1) union() { cube(6, \"red\"); rectprism((12, 1, 1), \"red\"); }"},
        {"closing", "Fills the parts that a ball outside its child cannot reach: holes, gaps and notches.",
         "closing(1) difference() { cube(6, \"red\"); rectprism((12, 1, 1), \"red\"); }"}};
    const Words& word = words[static_cast<size_t>(what)];
    return {word.name,
            word.sentence,
            {{"radius", &Morphed::radius, "Radius of the ball", required(positive("mm"))},
             {"pitch", &Morphed::pitch, about_pitch, unit::positive_mm}},
            one_solid,
            word.example};
  }

  bool complete(const Reader&, const std::vector<NodePtr>& inputs) {
    stage = make_morphology_stage(inputs[0], what, radius, pitch);
    return true;
  }
};

}  // namespace

void add_convolutions(Registry& registry) {
  registry.add<VoxelBlend, Convolve, Gaussian, Sharpen, Majority, Median, Smooth, Morphed<Morphology::dilate>,
               Morphed<Morphology::erode>, Morphed<Morphology::opening>, Morphed<Morphology::closing>>("convolutions");
}

}  // namespace ombre::nodes
