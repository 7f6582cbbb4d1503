#include "solids/operations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/error.h"
#include "solids/extrusions.h"
#include "solids/kernel.h"
#include "solids/mended_solid.h"
#include "solids/piece_attributes.h"
#include "solids/regions.h"
#include "solids/roofs.h"

namespace ombre::solids {
namespace {

Piece piece_of(Attributes attributes, Solid solid) {
  if (solid.is_empty()) return {std::move(attributes), {}};
  return {std::move(attributes), std::move(solid)};
}

Piece piece_of(Attributes attributes, Region region) {
  if (region.is_empty()) return {std::move(attributes), {}};
  return {std::move(attributes), std::move(region)};
}

std::vector<Solid> solids_of(const Pieces& pieces) {
  std::vector<Solid> solids;
  for (const Piece& piece : pieces)
    if (piece.solid()) solids.push_back(*piece.solid());
  return solids;
}

std::vector<Region> regions_of(const Pieces& pieces) {
  std::vector<Region> regions;
  for (const Piece& piece : pieces)
    if (piece.region()) regions.push_back(*piece.region());
  return regions;
}

int dimension_of(const Pieces& pieces) {
  for (const Piece& piece : pieces)
    if (piece.dimension() != 0) return piece.dimension();
  return 0;
}

// Applies one operation to the pieces of its children.
class Applier {
 public:
  Applier(const Tree& tree, const std::vector<const Pieces*>& children, const OperationContext& context)
      : tree_(tree), context_(context) {
    for (const Pieces* child : children) {
      children_.push_back(*child);
      if (child->empty()) children_.back().push_back({});
    }
    if (children_.empty()) children_.push_back({Piece{}});
  }

  Pieces operator()(const Group&) { return soft_union(of_any_dimension()); }
  Pieces operator()(const Union& by) {
    if (by.render) return soft_union(of_any_dimension());
    warn_of_colours("union", "leave union() out");
    return for_groups([&](const PieceGroup& group) { return united(group); });
  }
  Pieces operator()(const Intersection&) {
    return combined([&](const Piece& a, const Piece& b) { return intersected(a, b); });
  }
  Pieces operator()(const Hull&) {
    warn_of_colours("hull", "write hull() for each colour");
    return for_groups([&](const PieceGroup& group) { return hulled(group); });
  }
  Pieces operator()(const Minkowski&) {
    return combined([&](const Piece& a, const Piece& b) { return summed(a, b); });
  }
  Pieces operator()(const Difference&);

  Pieces operator()(const Fill&) {
    warn_of_colours("fill", "write fill() for each colour");
    return for_regions(matching(), [&](const Region& region) { return fill(region); });
  }
  Pieces operator()(const Offset& by) {
    warn_of_colours("offset", "write offset() for each colour");
    return for_regions(matching(), [&](const Region& region) { return offset(region, by); });
  }
  Pieces operator()(const LinearExtrude& by) {
    // With a twist or other scales, slices may cross or their ends may meet in a line.
    const bool is_sound = by.twist == 0 && ((by.scale.x > 0 && by.scale.y > 0) || by.scale == Vec2{0, 0});
    return for_regions(apart(), [&](const Region& region) { return checked(extruded(region, by), is_sound); });
  }
  Pieces operator()(const RotateExtrude& by) {
    return for_regions(apart(), [&](const Region& region) {
      return checked(revolved(region, by, tree_.where, *context_.messages), true);
    });
  }
  Pieces operator()(const Roof& by) {
    return for_regions(apart(), [&](const Region& region) { return checked(roof_of(region, by), false, "the roof"); });
  }
  Pieces operator()(const Projection& by) {
    return for_solids(apart(),
                      [&](const Solid& solid) { return by.cut ? section(solid.mesh()) : shadow(solid.mesh()); });
  }
  Pieces operator()(const Resize& to);
  Pieces operator()(const Transform& by);
  Pieces operator()(const SetColour& set) {
    return with([&](Attributes& attributes) { attributes.colour = set.colour; });
  }
  Pieces operator()(const SetPart& set) {
    return with([&](Attributes& attributes) { attributes.part = set.name; });
  }
  Pieces operator()(const SetMaterial& set) {
    return with([&](Attributes& attributes) { attributes.material = set.name; });
  }
  Pieces operator()(const Word& word) {
    context_.messages->error(tree_.where, word.name + "() makes a solid of a design, which is no polyhedron");
    return {};
  }
  template <class Leaf>
  Pieces operator()(const Leaf&) {
    return {};
  }

 private:
  Matching matching() const {
    switch (tree_.semantics) {
      case Semantics::strict:
        return Matching::all;
      case Semantics::permissive:
        return Matching::none;
      case Semantics::standard:
        break;
    }
    return Matching::material;
  }
  // The attributes that keep pieces apart in operations that give the same for each piece as for all of them together.
  Matching apart() const { return tree_.semantics == Semantics::permissive ? Matching::none : Matching::all; }

  void warn(const std::string& text) const { context_.messages->warning(tree_.where, text); }

  Pieces all() const {
    Pieces pieces;
    for (const Pieces& child : children_) pieces.insert(pieces.end(), child.begin(), child.end());
    return pieces;
  }

  // Returns the place of a child; children of the background are not counted.
  const SourceRange& place_of_child(size_t number) const {
    for (const TreePtr& child : tree_.children)
      if (child && !child->background && number-- == 0) return child->where;
    return tree_.where;
  }

  // Keeps pieces of one dimension and makes the others empty, with a warning for each child that has others.
  void keep_dimension(int dimension, bool warns, bool is_mixture = false) {
    for (size_t n = 0; n < children_.size(); ++n) {
      bool has_other = false;
      for (Piece& piece : children_[n]) {
        if (piece.dimension() == 0 || piece.dimension() == dimension) continue;
        has_other = true;
        piece.shape = std::monostate{};
      }
      if (!has_other || !warns) continue;
      if (std::exchange(is_mixture, false))
        context_.messages->warning(place_of_child(n), "Mixing 2D and 3D objects is not supported");
      context_.messages->warning(place_of_child(n), dimension == 3 ? "Ignoring 2D child object for 3D operation"
                                                                   : "Ignoring 3D child object for 2D operation");
    }
  }

  // Returns all pieces that have the dimension of the first.
  Pieces of_any_dimension() {
    keep_dimension(dimension_of(all()), true, true);
    return all();
  }

  Piece united(const PieceGroup& group) const {
    if (dimension_of(group.members) == 2) {
      const std::vector<Region> regions = regions_of(group.members);
      return piece_of(group.attributes, unite(std::span(regions)));
    }
    return piece_of(group.attributes, unite(solids_of(group.members), context_.work));
  }

  // The pieces have the same dimension, or one is empty.
  Piece intersected(const Piece& a, const Piece& b) const {
    Attributes attributes = completed(a.attributes, b.attributes);
    if (a.dimension() == 0 || b.dimension() == 0) return {std::move(attributes), {}};
    if (a.solid()) return piece_of(std::move(attributes), intersect({*a.solid(), *b.solid()}, context_.work));
    return piece_of(std::move(attributes), intersect(*a.region(), *b.region()));
  }

  Piece hulled(const PieceGroup& group) const {
    if (dimension_of(group.members) == 2) {
      const std::vector<Region> regions = regions_of(group.members);
      return piece_of(group.attributes, hull(std::span(regions)));
    }
    return piece_of(group.attributes, hull(solids_of(group.members)));
  }

  Piece summed(const Piece& a, const Piece& b) const {
    Attributes attributes = completed(a.attributes, b.attributes);
    // OpenSCAD passes over empty children in space; in the plane, the sum is empty.
    if (a.dimension() + b.dimension() == 3) return {std::move(attributes), a.solid() ? a.shape : b.shape};
    if (a.dimension() == 0 || b.dimension() == 0) return {std::move(attributes), {}};
    if (a.solid()) return piece_of(std::move(attributes), minkowski(*a.solid(), *b.solid(), context_.work));
    return piece_of(std::move(attributes), minkowski(*a.region(), *b.region()));
  }

  // True if `combine` takes the pieces together. An empty piece empties those of the same part and material alone.
  bool do_act(const Piece& a, const Piece& b) const {
    const bool is_empty = a.dimension() == 0 || b.dimension() == 0;
    return is_empty ? do_match(a.attributes, b.attributes, matching())
                    : do_agree(a.attributes, b.attributes, matching());
  }

  // Combines each piece of the first child with each piece of the second that agrees with it, the results with the
  // third child, and so on. Pieces that agree with none stay as they are.
  template <class Combine>
  Pieces combined(const Combine& combine) {
    of_any_dimension();
    join_children();
    Pieces result = children_[0];
    for (size_t n = 1; n < children_.size(); ++n) {
      const Pieces& next = children_[n];
      std::vector<bool> has_acted(next.size());
      Pieces made;
      for (const Piece& piece : result) {
        const size_t before = made.size();
        for (size_t m = 0; m < next.size(); ++m) {
          if (!do_act(piece, next[m])) continue;
          made.push_back(combine(piece, next[m]));
          has_acted[m] = true;
        }
        if (made.size() == before) made.push_back(piece);
      }
      for (size_t m = 0; m < next.size(); ++m)
        if (!has_acted[m]) made.push_back(next[m]);
      result = soft_union(made);
    }
    return result;
  }

  // Returns one united piece for each set of attributes; empty pieces are removed if others exist.
  Pieces soft_union(const Pieces& pieces) const {
    Pieces result;
    for (const PieceGroup& group : grouped(pieces, Matching::all)) result.push_back(united(group));
    if (!context_.keeps_empty && dimension_of(result) != 0)
      std::erase_if(result, [](const Piece& piece) { return piece.dimension() == 0; });
    return result;
  }

  // If attributes do not matter, unites each child into one piece.
  void join_children() {
    if (tree_.semantics != Semantics::permissive) return;
    for (Pieces& child : children_)
      if (child.size() > 1) child = {united(grouped(child, Matching::none).at(0))};
  }

  template <class Operate>
  Pieces for_groups(const Operate& operate) {
    of_any_dimension();
    join_children();
    Pieces result;
    for (const PieceGroup& group : grouped(all(), matching())) result.push_back(operate(group));
    return result;
  }

  // Replaces the shapes of one kind, which `part` gives; pieces without one stay.
  template <auto part, class Operate>
  Pieces for_united(Matching matching, const Operate& operate) {
    Pieces result;
    for (const PieceGroup& group : grouped(all(), matching)) {
      const Piece piece = united(group);
      const auto* const shape = (piece.*part)();
      result.push_back(shape ? piece_of(group.attributes, operate(*shape)) : piece);
    }
    return result;
  }

  template <class Operate>
  Pieces for_regions(Matching matching, const Operate& operate) {
    keep_dimension(2, true);
    return for_united<&Piece::region>(matching, operate);
  }

  template <class Operate>
  Pieces for_solids(Matching matching, const Operate& operate) {
    keep_dimension(3, false);
    return for_united<&Piece::solid>(matching, operate);
  }

  template <class Set>
  Pieces with(const Set& set) {
    Pieces pieces = soft_union(of_any_dimension());
    for (Piece& piece : pieces)
      if (piece.dimension() != 0 || context_.keeps_empty) set(piece.attributes);
    return soft_union(pieces);
  }

  // Returns the solid of a mesh, repaired by the kernel if the mesh may cross itself.
  Solid checked(TriangleMesh mesh, bool is_sound, const char* name = "the extrusion") const {
    if (!is_finite(mesh)) return Solid(TriangleMesh{});
    if (is_sound || mesh.triangles.empty()) return Solid(std::move(mesh));
    const auto solid = mended_solid(std::move(mesh), name, tree_.where, *context_.messages);
    return solid ? *solid : Solid(TriangleMesh{});
  }

  // Says so if pieces of several colours become one piece, which has the colour of the first.
  void warn_of_colours(const std::string& name, const std::string& advice) const {
    const auto joins_colours = [](const PieceGroup& group) {
      return std::ranges::any_of(group.members, [&](const Piece& piece) {
        return piece.dimension() != 0 && piece.attributes.colour && piece.attributes.colour != group.attributes.colour;
      });
    };
    if (std::ranges::any_of(grouped(all(), matching()), joins_colours))
      warn(name + "() joins shapes of several colours, and the result has the colour of the first; " + advice +
           ", or write semantics = \"strict\"");
  }

  const Tree& tree_;
  const OperationContext& context_;
  std::vector<Pieces> children_;
};

Pieces Applier::operator()(const Difference&) {
  of_any_dimension();
  join_children();
  Pieces others;
  for (size_t n = 1; n < children_.size(); ++n) others.insert(others.end(), children_[n].begin(), children_[n].end());
  Pieces result;
  for (const Piece& piece : children_[0]) {
    Pieces matching = others;
    if (tree_.semantics == Semantics::strict)
      std::erase_if(matching,
                    [&](const Piece& other) { return !do_agree(other.attributes, piece.attributes, Matching::all); });
    if (piece.solid())
      result.push_back(piece_of(piece.attributes, subtract(*piece.solid(), solids_of(matching), context_.work)));
    else if (piece.region()) {
      const std::vector<Region> regions = regions_of(matching);
      result.push_back(piece_of(piece.attributes, subtract(*piece.region(), unite(std::span(regions)))));
    } else
      result.push_back(piece);
  }
  return result;
}

Pieces Applier::operator()(const Transform& by) {
  const Affine& map = by.parent_from_child;
  Pieces pieces = soft_union(of_any_dimension());
  const bool is_finite_map =
      is_finite(map.rows[0]) && is_finite(map.rows[1]) && is_finite(map.rows[2]) && is_finite(map.offset);
  if (!is_finite_map) {
    warn("Transformation matrix contains Not-a-Number and/or Infinity - removing object.");
    for (Piece& piece : pieces) piece.shape = std::monostate{};
    return pieces;
  }
  for (Piece& piece : pieces) {
    if (piece.region()) {
      piece = piece_of(piece.attributes, moved(*piece.region(), map));
      if (piece.dimension() == 0) warn("Scaling a 2D object with 0 - removing object");
    } else if (piece.solid()) {
      const double factor = determinant(map);
      if (factor == 0) warn("Scaling a 3D object with 0 - removing object");
      piece = factor == 0 ? Piece{piece.attributes, {}} : piece_of(piece.attributes, moved(*piece.solid(), map));
    }
  }
  return pieces;
}

// Returns the factors that give the box its new size; automatic axes use the factor of the axis with the greatest new
// size.
Vec3 factors_of(const Resize& to, const Vec3& size, int axes) {
  Vec3 factors{1, 1, 1};
  int greatest = 0;
  for (int axis = 1; axis < axes; ++axis)
    if (to.size[axis] > to.size[greatest]) greatest = axis;
  const auto factor = [&](int axis) { return size[axis] > 0 ? to.size[axis] / size[axis] : 1; };
  if (!(to.size[greatest] > 0)) return factors;
  for (int axis = 0; axis < axes; ++axis) {
    if (to.size[axis] > 0)
      factors[axis] = factor(axis);
    else if (to.automatic[axis])
      factors[axis] = factor(greatest);
  }
  return factors;
}

// The box of all pieces gets the new size.
Pieces Applier::operator()(const Resize& to) {
  const Pieces pieces = soft_union(of_any_dimension());
  Box box;
  for (const Piece& piece : pieces) {
    if (piece.solid()) box = ombre::hull(box, piece.solid()->bounds());
    if (piece.region()) box = ombre::hull(box, bounds_of(*piece.region()));
  }
  const Affine map = Affine::scaling(factors_of(to, box.size(), dimension_of(pieces)));
  Pieces result;
  for (const Piece& piece : pieces) {
    if (piece.solid())
      result.push_back(piece_of(piece.attributes, moved(*piece.solid(), map)));
    else if (piece.region())
      result.push_back(piece_of(piece.attributes, moved(*piece.region(), map)));
    else
      result.push_back(piece);
  }
  return result;
}

}  // namespace

Pieces apply(const Tree& tree, const std::vector<const Pieces*>& children, const OperationContext& context) {
  Pieces result;
  try {
    result = std::visit(Applier(tree, children, context), tree.operation);
  } catch (const Error& error) {
    context.messages->error(tree.where, error.what());
  }
  if (!context.keeps_empty)
    for (Piece& piece : result)
      if (piece.dimension() == 0) piece.attributes = {};
  if (result.empty()) result.push_back({});
  return result;
}

}  // namespace ombre::solids
