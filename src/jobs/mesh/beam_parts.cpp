#include "jobs/mesh/beam_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "base/text/text.h"
#include "jobs/mesh/strut_frames.h"
#include "nodes/all_nodes.h"
#include "questions/build.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using design::Node;
using design::NodePtr;
using formats::LatticeClipping;
using nodes::StrutShape;
using nodes::TileCopies;

constexpr double most_struts = 1e8;  // some ten gigabytes

// The clips of struts, in the design's frame: struts keep their part inside of all of `inside` and outside of all of
// `outside`.
struct Clips {
  std::vector<NodePtr> inside, outside;
  bool operator==(const Clips&) const = default;
  bool operator<(const Clips& other) const { return std::tie(inside, outside) < std::tie(other.inside, other.outside); }
};

// Struts in a frame of their own, and the tile that repeats them there, if any.
struct Piece {
  std::vector<StrutShape> struts;
  std::optional<TileCopies> copies;
  Affine design_from_here;
  Clips clips;
};

struct Split {
  std::vector<Piece> pieces;
  NodePtr rest;  // null: nothing is left
};

StrutShape placed(const StrutShape& strut, const Affine& map, double scale) {
  return {map(strut.start), map(strut.end), scale * strut.start_radius, scale * strut.end_radius, strut.has_flat_ends};
}

bool is_a(const Node& node, std::string_view type) { return node.type().name == type; }

// Returns the indices of the copies that may meet the box; empty if there are none.
std::array<Interval, 3> copies_within(const TileCopies& copies, const Box& original, const Box& where) {
  std::array<Interval, 3> found = copies.indices;
  for (int axis = 0; axis < 3; ++axis) {
    Interval& range = found[static_cast<size_t>(axis)];
    const double step = copies.steps[axis];
    if (step == 0) continue;
    range.lo = std::max(range.lo, std::ceil((where.lo[axis] - original.hi[axis]) / step));
    range.hi = std::min(range.hi, std::floor((where.hi[axis] - original.lo[axis]) / step));
  }
  return found;
}

double count_of(const std::array<Interval, 3>& indices) {
  double count = 1;
  for (const Interval& range : indices) count *= std::max(0.0, range.hi - range.lo + 1);
  return count;
}

// Makes nodes for a design.
struct NodeMaker {
  const design::Design& design;
  Diagnostics& diagnostics;
  SourceRange where;

  NodePtr make(std::string_view type, const std::vector<std::pair<std::string_view, Data>>& values,
               std::vector<NodePtr> inputs) const {
    const design::NodeType& made = *nodes::registry().find(type);
    std::vector<design::NamedValue> named;
    for (const auto& [name, data] : values)
      named.push_back({&made.parameters[static_cast<size_t>(made.parameter(name))], data});
    return design::make_node(made, named, std::move(inputs), {design.materials, diagnostics, nullptr, where, "", ""});
  }

  NodePtr placed(const NodePtr& node, const Affine& map) const {
    return make("matrix", {{"matrix", design::write(map, false)}}, {node});
  }

  NodePtr box(const Box& box) const {
    const NodePtr centred = make("rectprism", {{"size", design::write(box.size(), false)}}, {});
    return placed(centred, Affine::translation(box.center()));
  }

  NodePtr joined(std::string_view type, const std::vector<NodePtr>& solids) const {
    return solids.size() == 1 ? solids[0] : make(type, {}, solids);
  }
};

class Splitter {
 public:
  Splitter(const design::Design& design, int threads, Diagnostics& diagnostics)
      : design_(design),
        threads_(threads),
        diagnostics_(diagnostics),
        root_(whole_solid(design)),
        maker_{design, diagnostics, root_->where()} {
    for (const Node* node : design::topological({root_})) {
      const auto has_struts = [&](const NodePtr& input) { return with_struts_.contains(input.get()); };
      if (nodes::makes_struts(*node) || std::ranges::any_of(node->inputs(), has_struts)) with_struts_.insert(node);
    }
  }

  std::optional<BeamParts> make() {
    const std::optional<Box> box = design_box(design_, diagnostics_);
    if (!box) return std::nullopt;
    Split split = split_node(root_, {});
    clip_to_samples(split);
    BeamParts parts;
    parts.rest = split.rest;
    for (const Piece& piece : split.pieces)
      if (!add_piece(piece, *box, parts)) break;
    if (strut_count_ > most_struts) {
      diagnostics_.error(Code::too_large, root_->where(),
                         "the design has more than " + format_count(static_cast<unsigned long long>(most_struts)) +
                             " struts, too many to write as beams");
      return std::nullopt;
    }
    for (BeamSet& set : parts.sets) leave_out_clipped(set, design_.materials, threads_);
    std::erase_if(parts.sets, [](const BeamSet& set) { return set.struts.empty(); });
    report_lost(*box, parts.sets.empty() ? "no beams" : "written as triangles");
    if (!parts.sets.empty()) return parts;
    diagnostics_.error(Code::nothing_inside, root_->where(), "the design has no struts that can be written as beams",
                       "leave " + spelled::option("--beams") +
                           " out; struts are what lattice, strut, voronoi_struts and delaunay_struts make");
    return std::nullopt;
  }

 private:
  struct Lost {
    const Node* cause;
    NodePtr node;
    Affine design_from_here;
  };
  struct LostCount {
    double known = 0;
    bool has_more = false;  // lattices on maps, whose struts are not counted
  };

  Split split_node(const NodePtr& node, const Affine& design_from_here) {
    if (!with_struts_.contains(node.get()) || strut_count_ > most_struts) return {{}, node};
    const size_t lost = lost_.size();
    if (auto split = split_known(node, design_from_here)) return std::move(*split);
    // A node loses the struts that its inputs lost; a tile repeats that number.
    const bool is_known = lost_.size() > lost && nodes::tile_copies_of(*node);
    const Node* cause = is_known ? lost_[lost].cause : node.get();
    lost_.resize(lost);
    lost_.push_back({cause, node, design_from_here});
    return {{}, node};
  }

  // Returns nothing if struts below this node are not beams.
  std::optional<Split> split_known(const NodePtr& node, const Affine& design_from_here) {
    if (nodes::makes_struts(*node)) return split_lattice(*node, design_from_here);
    const auto frame = input_frame(*node);
    if (!frame) return std::nullopt;
    if (frame->copies) return split_tile(*node, *frame->copies, design_from_here);
    if (is_boolean(*node)) return split_boolean(node, design_from_here);
    if (!scale_of_similarity(frame->here_from_input)) return std::nullopt;
    return split_input(node, design_from_here * frame->here_from_input);
  }

  std::optional<Split> split_boolean(const NodePtr& node, const Affine& design_from_here) {
    if (!is_sharp(*node)) return std::nullopt;
    if (is_a(*node, "union")) return split_union(node, design_from_here);
    if (is_a(*node, "intersection")) return split_intersection(node, design_from_here);
    return split_difference(node, design_from_here);
  }

  std::optional<Split> split_lattice(const Node& node, const Affine& design_from_here) {
    auto made = nodes::struts_of(node).struts;
    if (!made) return std::nullopt;
    // Ends that floats cannot distinguish would make no beam.
    constexpr double rounding = 1e-6;
    for (const StrutShape& strut : made->struts) {
      const Vec3 start = design_from_here(strut.start), end = design_from_here(strut.end);
      if (length(end - start) < rounding * (1 + length(start))) return std::nullopt;
    }
    strut_count_ += static_cast<double>(made->struts.size());
    Split split;
    split.pieces.push_back({std::move(made->struts), made->copies, design_from_here, {}});
    if (!made->region.node) return split;
    NodePtr region = in_design(region_of(node, made->region), design_from_here);
    if (!region) return std::nullopt;
    clip_pieces(split, {{std::move(region)}, {}});
    return split;
  }

  // Returns a solid that a parameter of the node holds.
  NodePtr region_of(const Node& node, const design::SolidName& name) const {
    const Data given = design::write_solid({name.node, name.output});
    return solid_of(design::with_held_nodes(given, node.values()), design_.materials, root_->where(), diagnostics_);
  }

  std::optional<Split> split_input(const NodePtr& node, const Affine& design_from_input) {
    Split split = split_node(node->inputs()[0], design_from_input);
    if (split.pieces.empty()) return Split{{}, node};
    if (split.rest) split.rest = node->type().with_inputs(*node, {split.rest});
    return split;
  }

  // Splits a tile whose copies are struts alone and keep their whole length.
  std::optional<Split> split_tile(const Node& node, const TileCopies& copies, const Affine& design_from_here) {
    Split inner = split_node(node.inputs()[0], {});
    const auto is_plain = [](const Piece& piece) { return !piece.copies && piece.clips == Clips{}; };
    if (inner.rest || !std::ranges::all_of(inner.pieces, is_plain)) return std::nullopt;
    Piece cell{{}, copies, design_from_here, {}};
    for (const Piece& piece : inner.pieces) {
      const double scale = *scale_of_similarity(piece.design_from_here);
      for (const StrutShape& strut : piece.struts) cell.struts.push_back(placed(strut, piece.design_from_here, scale));
    }
    Split split;
    split.pieces.push_back(std::move(cell));
    return split;
  }

  std::optional<Split> split_union(const NodePtr& node, const Affine& design_from_here) {
    Split split;
    std::vector<NodePtr> rest;
    for (const NodePtr& input : node->inputs()) {
      Split part = split_node(input, design_from_here);
      std::ranges::move(part.pieces, std::back_inserter(split.pieces));
      if (part.rest) rest.push_back(part.rest);
    }
    if (split.pieces.empty()) return Split{{}, node};
    if (!rest.empty()) split.rest = node->type().with_inputs(*node, std::move(rest));
    return split;
  }

  std::optional<Split> split_intersection(const NodePtr& node, const Affine& design_from_here) {
    const auto has_struts = [&](const NodePtr& input) { return with_struts_.contains(input.get()); };
    if (std::ranges::count_if(node->inputs(), has_struts) != 1) return std::nullopt;
    std::vector<NodePtr> inputs(node->inputs().begin(), node->inputs().end());
    const auto own = std::ranges::find_if(inputs, has_struts);
    Split split = split_node(*own, design_from_here);
    if (split.pieces.empty()) return Split{{}, node};
    Clips clips;
    for (const NodePtr& input : inputs) {
      if (input == *own) continue;
      const bool is_negated = is_a(*input, "negate");
      NodePtr clip = in_design(is_negated ? input->inputs()[0] : input, design_from_here);
      if (!clip) return std::nullopt;
      (is_negated ? clips.outside : clips.inside).push_back(std::move(clip));
    }
    clip_pieces(split, clips);
    if (!split.rest) return split;
    *own = split.rest;
    split.rest = node->type().with_inputs(*node, std::move(inputs));
    return split;
  }

  std::optional<Split> split_difference(const NodePtr& node, const Affine& design_from_here) {
    const auto has_struts = [&](const NodePtr& input) { return with_struts_.contains(input.get()); };
    std::vector<NodePtr> inputs(node->inputs().begin(), node->inputs().end());
    if (!has_struts(inputs[0]) || std::any_of(inputs.begin() + 1, inputs.end(), has_struts)) return std::nullopt;
    Split split = split_node(inputs[0], design_from_here);
    if (split.pieces.empty()) return Split{{}, node};
    Clips clips;
    for (size_t n = 1; n < inputs.size(); ++n) {
      clips.outside.push_back(in_design(inputs[n], design_from_here));
      if (!clips.outside.back()) return std::nullopt;
    }
    clip_pieces(split, clips);
    if (!split.rest) return split;
    inputs[0] = split.rest;
    split.rest = node->type().with_inputs(*node, std::move(inputs));
    return split;
  }

  static void clip_pieces(Split& split, const Clips& clips) {
    for (Piece& piece : split.pieces) {
      std::ranges::copy(clips.inside, std::back_inserter(piece.clips.inside));
      std::ranges::copy(clips.outside, std::back_inserter(piece.clips.outside));
    }
  }

  // The box of `root` clips struts that reach beyond it.
  void clip_to_samples(Split& split) {
    if (!design_.sampling) return;
    const Box& box = design_.sampling->box;
    const Box whole = root_->bounds(design::design_space());
    if (hull(box, whole) != box) clip_pieces(split, {{maker_.box(box)}, {}});
  }

  NodePtr in_design(const NodePtr& node, const Affine& design_from_here) {
    if (design_from_here.is_identity()) return node;
    std::array<double, 12> numbers{};
    for (size_t n = 0; n < numbers.size(); ++n) {
      const auto row = static_cast<int>(n / 4), column = static_cast<int>(n % 4);
      numbers[n] = column < 3 ? design_from_here.rows[n / 4][column] : design_from_here.offset[row];
    }
    NodePtr& known = placed_[{node.get(), numbers}];
    if (!known) known = maker_.placed(node, design_from_here);
    return known;
  }

  // Returns the set of clips with both kinds joined to one solid.
  BeamSet set_of(const Clips& clips) const {
    std::vector<NodePtr> outside = clips.outside;
    std::erase_if(outside, [](const NodePtr& clip) { return clip->bounds(design::design_space()).is_empty(); });
    if (clips.inside.empty() && outside.empty()) return {};
    if (clips.inside.empty()) return {{}, LatticeClipping::outside, maker_.joined("union", outside)};
    outside.insert(outside.begin(), maker_.joined("intersection", clips.inside));
    return {{}, LatticeClipping::inside, maker_.joined("difference", outside)};
  }

  // Appends the struts within the box to the set of their clips. Returns false if there are too many.
  bool add_piece(const Piece& piece, Box box, BeamParts& parts) {
    const auto [known, is_new] = sets_.try_emplace(piece.clips, parts.sets.size());
    if (is_new) {
      parts.sets.push_back(set_of(piece.clips));
      Box within = Box::everything();
      for (const NodePtr& clip : piece.clips.inside) within = intersect(within, clip->bounds(design::design_space()));
      boxes_.push_back(within);
    }
    BeamSet& set = parts.sets[known->second];
    box = intersect(box, boxes_[known->second]);
    const Box where = image(inverse(piece.design_from_here), box);
    const TileCopies one;
    const TileCopies& copies = piece.copies ? *piece.copies : one;
    const auto indices = copies_within(copies, reach(piece.struts), where);
    // One copy was counted when it was found.
    strut_count_ += (count_of(indices) - 1) * static_cast<double>(piece.struts.size());
    if (strut_count_ > most_struts) return false;
    const double scale = *scale_of_similarity(piece.design_from_here);
    const auto [along_x, along_y, along_z] = indices;
    for (double k = along_z.lo; k <= along_z.hi; ++k)
      for (double j = along_y.lo; j <= along_y.hi; ++j)
        for (double i = along_x.lo; i <= along_x.hi; ++i) {
          const Vec3 by{i * copies.steps.x, j * copies.steps.y, k * copies.steps.z};
          const Affine map = piece.design_from_here * Affine::translation(by);
          for (const StrutShape& strut : piece.struts) {
            const StrutShape copy = placed(strut, map, scale);
            if (!intersect(reach(copy), box).is_empty()) set.struts.push_back(copy);
          }
        }
    return true;
  }

  // Counts the struts below the node within a box of its frame. Nodes that are used more than once are counted at their
  // first use.
  LostCount count_struts(const Node& node, const Box& where) {
    if (!with_struts_.contains(&node)) return {};
    if (nodes::makes_struts(node)) {
      const size_t count = nodes::strut_count(node);
      return {static_cast<double>(count), count == 0};
    }
    if (const auto known = counts_.find(&node); known != counts_.end()) return known->second;
    double copies = 1;
    Box below = node.bounds(where);
    const auto frame = input_frame(node);
    if (frame && frame->copies) {
      const Box original = node.inputs()[0]->bounds(design::design_space());
      copies = count_of(copies_within(*frame->copies, original, below));
      below = original;
    } else if (frame) {
      below = image(inverse(frame->here_from_input), below);
    } else if (node.inner(origin())) {
      below = design::design_space();
    }
    LostCount count;
    for (const NodePtr& input : node.inputs()) add(count_struts(*input, below), copies, count);
    counts_.emplace(&node, count);
    return count;
  }

  static void add(const LostCount& part, double copies, LostCount& sum) {
    sum.known += copies * part.known;
    sum.has_more = sum.has_more || part.has_more;
  }

  // Returns the subject and the verb of a sentence.
  static std::string struts_are(const LostCount& lost) {
    const auto count = static_cast<unsigned long long>(lost.known);
    if (count == 0) return "struts are";
    const std::string known = format_count(count) + (count == 1 ? " strut" : " struts");
    if (lost.has_more) return known + " and those of maps of cells are";
    return known + (count == 1 ? " is" : " are");
  }

  // Reports each reason once, at the first node that gives it.
  void report_lost(const Box& box, const std::string& what_they_are) {
    std::map<std::string, LostCount> counts;
    for (const Lost& lost : lost_)
      add(count_struts(*lost.node, image(inverse(lost.design_from_here), box)), 1, counts[reason_of(*lost.cause)]);
    for (const Lost& lost : lost_) {
      const auto found = counts.find(reason_of(*lost.cause));
      if (found == counts.end()) continue;
      diagnostics_.warning(lost.cause->where(),
                           struts_are(found->second) + ' ' + what_they_are + ", because " + found->first);
      counts.erase(found);
    }
  }

  static std::string reason_of(const Node& cause) {
    const std::string own = nodes::struts_of(cause).reason;
    return !own.empty() ? own : "beams cannot have the shape that \"" + cause.type().name + "\" makes of them";
  }

  program::Point origin() { return program::Point::origin_frame(builder_); }

  const design::Design& design_;
  int threads_;
  Diagnostics& diagnostics_;
  NodePtr root_;
  NodeMaker maker_;
  program::Builder builder_;
  std::unordered_set<const Node*> with_struts_;
  std::vector<Lost> lost_;
  std::unordered_map<const Node*, LostCount> counts_;
  std::map<Clips, size_t> sets_;
  std::vector<Box> boxes_;  // boxes around the clipped struts of each set
  std::map<std::pair<const Node*, std::array<double, 12>>, NodePtr> placed_;  // solids in the frame of the design
  double strut_count_ = 0;
};

}  // namespace

bool is_sharp(const Node& node) {
  const int blend = node.type().parameter("blend");
  return blend < 0 || node.inputs().size() < 2 || node.type().get(node, static_cast<size_t>(blend), false) == Data(0.0);
}

void leave_out_clipped(BeamSet& set, const design::MaterialTable& materials, int threads) {
  if (!set.clip || set.clip->metric().is_implicit()) return;
  const double lipschitz = set.clip->metric().lipschitz, sign = set.clipping == LatticeClipping::inside ? 1 : -1;
  Diagnostics none;
  const design::Design clip{materials, {{"", set.clip}}, {}};
  const auto sampler = Sampler::build(clip, {false, true, false, false, {}}, none);
  if (!sampler) return;
  std::vector<Vec3> middles;
  for (const StrutShape& strut : set.struts) middles.push_back(0.5 * (strut.start + strut.end));
  std::vector<double> distances(middles.size());
  sampler->sample(middles, std::array{distances.data()}, threads);
  size_t kept = 0;
  for (size_t n = 0; n < set.struts.size(); ++n) {
    const StrutShape& strut = set.struts[n];
    const double farthest = 0.5 * length(strut.end - strut.start) + std::max(strut.start_radius, strut.end_radius);
    if (sign * distances[n] > 1.001 * lipschitz * farthest) continue;
    set.struts[kept++] = strut;
  }
  set.struts.resize(kept);
}

std::optional<BeamParts> split_beams(const design::Design& design, int threads, Diagnostics& diagnostics) {
  return Splitter(design, threads, diagnostics).make();
}

NodePtr clip_near_struts(const design::Design& design, const BeamSet& set, Diagnostics& diagnostics) {
  constexpr double margin = 0.05;
  const Box box = reach(set.struts);
  const NodeMaker maker{design, diagnostics, set.clip->where()};
  return maker.joined("intersection", {set.clip, maker.box(box.expanded(margin * length(box.size())))});
}

}  // namespace ombre::compile
