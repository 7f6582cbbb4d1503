// Finds what a study means for the nodes of a mesh.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "fea/model/study.h"

namespace ombre::fea {
namespace {

// Tolerance, as a share of an element, within which a node counts as inside of a box or on a side. Nodes of tetrahedra
// come this near to the surface.
constexpr double slack_of_brick = 1e-6, slack_of_tetrahedron = 0.02;

double slack_of(const MeshView& mesh) {
  return (mesh.shape().corners == 4 ? slack_of_tetrahedron : slack_of_brick) * mesh.typical_size_mm();
}

struct Chosen {
  std::vector<bool> nodes;
  std::vector<OuterSide> sides;  // sides all of whose nodes are chosen

  std::vector<uint32_t> list() const {
    std::vector<uint32_t> numbers;
    for (uint32_t n = 0; n < nodes.size(); ++n)
      if (nodes[n]) numbers.push_back(n);
    return numbers;
  }
};

// Finds the nodes of a selection, and adds a diagnostic if there are none.
class Selector {
 public:
  Selector(const ModelView& model, const ChooseNodes& choose, Diagnostics& diagnostics)
      : model_(model),
        mesh_(model.mesh),
        choose_(choose),
        diagnostics_(diagnostics),
        bounds_(mesh_.bounds()),
        slack_(slack_of(mesh_)) {}

  Chosen choose(const Selection& selection) {
    Chosen chosen;
    const size_t errors = diagnostics_.error_count();
    chosen.nodes.resize(mesh_.node_count());
    for (size_t n = 0; n < chosen.nodes.size(); ++n) chosen.nodes[n] = holds(selection, mesh_.node(n));
    if (selection.material) keep(chosen.nodes, of_material(*selection.material));
    if (selection.part || selection.formula) keep(chosen.nodes, by_design(selection));
    for (const OuterSide& side : all_sides())
      if (std::ranges::all_of(side_nodes(mesh_, side), [&](uint32_t n) { return chosen.nodes[n]; }))
        chosen.sides.push_back(side);
    if (selection.facing) keep_facing(*selection.facing, chosen);
    if (diagnostics_.error_count() == errors && std::ranges::find(chosen.nodes, true) == chosen.nodes.end())
      diagnostics_.error(selection.where,
                         std::string("no node of the mesh lies ") + (selection.box ? "in this box" : "there"),
                         "the mesh lies from " + format_point(bounds_.lo) + " to " + format_point(bounds_.hi) + " mm");
    return chosen;
  }

 private:
  bool holds(const Selection& selection, Vec3 p) const {
    if (selection.side) {
      const auto [axis, is_upper] = *selection.side;
      if (std::abs(p[axis] - (is_upper ? bounds_.hi : bounds_.lo)[axis]) > slack_) return false;
    }
    if (selection.box && !selection.box->expanded(slack_).contains(p)) return false;
    return !selection.plane || std::abs(dot(p - selection.plane->point, selection.plane->normal)) <= slack_;
  }

  static void keep(std::vector<bool>& nodes, const std::vector<bool>& those) {
    for (size_t n = 0; n < nodes.size(); ++n) nodes[n] = nodes[n] && n < those.size() && those[n];
  }

  const std::vector<OuterSide>& all_sides() {
    if (sides_.empty()) sides_ = outer_sides(mesh_);
    return sides_;
  }

  // Chooses elements by material: in a drawn model those whose section has the name, else those that have most of it.
  std::vector<bool> of_material(const PlacedText& name) {
    const std::string wanted = to_lower(name.text);
    std::vector<bool> nodes(mesh_.node_count());
    const auto add = [&](size_t element) {
      for (const uint32_t n : mesh_.nodes(element)) nodes[n] = true;
    };
    for (size_t element = 0; element < mesh_.count(); ++element)
      if (to_lower(model_.section(element).name) == wanted) add(element);
    if (std::ranges::find(nodes, true) != nodes.end()) return nodes;
    const std::string prefix = "fraction of ";
    std::vector<const ValueField*> fractions;
    const ValueField* own = nullptr;
    for (const ValueField& field : model_.fields) {
      if (!field.name.starts_with(prefix)) continue;
      fractions.push_back(&field);
      if (to_lower(field.name.substr(prefix.size())) == wanted) own = &field;
    }
    if (!own) {
      std::vector<std::string> known;
      for (const ValueField* field : fractions) known.push_back(field->name.substr(prefix.size()));
      const std::string slip = did_you_mean(name.text, known);
      diagnostics_.error(name.where, "the mesh has no material \"" + name.text + "\"",
                         slip.empty() ? "it has " + join(known, ", ") : slip);
      return nodes;
    }
    for (size_t element = 0; element < mesh_.count(); ++element)
      if (std::ranges::all_of(fractions,
                              [&](const ValueField* field) { return field->values[element] <= own->values[element]; }))
        add(element);
    return nodes;
  }

  std::vector<bool> by_design(const Selection& selection) {
    if (choose_) return choose_(selection, diagnostics_).value_or(std::vector<bool>{});
    diagnostics_.error(selection.where, "parts and formulas need the design", "choose by a box or a side");
    return {};
  }

  void keep_facing(const Facing& facing, Chosen& chosen) {
    const double least = std::cos(facing.most_degrees * std::numbers::pi / 180);
    std::erase_if(chosen.sides, [&](const OuterSide& side) {
      const Vec3 area = side_area(mesh_, side);
      return dot(area, facing.direction) < least * length(area);
    });
    chosen.nodes.assign(mesh_.node_count(), false);
    for (const OuterSide& side : chosen.sides)
      for (const uint32_t n : side_nodes(mesh_, side)) chosen.nodes[n] = true;
  }

  const ModelView& model_;
  const MeshView& mesh_;
  const ChooseNodes& choose_;
  Diagnostics& diagnostics_;
  Box bounds_;
  double slack_;
  std::vector<OuterSide> sides_;  // all outer sides, once they are needed
};

// Forces at all nodes; heat is in their x.
class NodeForces {
 public:
  explicit NodeForces(const MeshView& mesh) : mesh_(mesh), at_(mesh.node_count()) {}

  // Distributes a force over the sides by their areas, or, without sides, evenly over the nodes.
  void add(const Chosen& chosen, Vec3 force) {
    double area = 0;
    for (const OuterSide& side : chosen.sides)
      for (const NodeShare& here : side_shares(mesh_, side)) area += here.share;
    if (area > 0) {
      for (const OuterSide& side : chosen.sides) share(side, (1 / area) * force);
      return;
    }
    const std::vector<uint32_t> nodes = chosen.list();
    for (const uint32_t n : nodes) at_[n] = at_[n] + (1 / static_cast<double>(nodes.size())) * force;
  }

  void add_pressure(const Chosen& chosen, double pressure) {
    for (const OuterSide& side : chosen.sides) {
      const Vec3 area = side_area(mesh_, side);
      share(side, (-pressure / length(area)) * area);
    }
  }

  void add_flux(const Chosen& chosen, double flux) {
    for (const OuterSide& side : chosen.sides) share(side, {flux, 0, 0});
  }

  void add_weight(const ModelView& model, Vec3 gravity) {
    for (size_t element = 0; element < mesh_.count(); ++element) {
      const Vec3 weight = model.elastic(element).density_t_mm3 * gravity;
      for (const NodeShare& here : volume_shares(mesh_, element)) at_[here.node] = at_[here.node] + here.share * weight;
    }
  }

  std::vector<Prescribed> list() const {
    std::vector<Prescribed> forces;
    for (uint32_t n = 0; n < at_.size(); ++n)
      for (uint8_t axis = 0; axis < 3; ++axis)
        if (at_[n][axis] != 0) forces.push_back({n, axis, at_[n][axis]});
    return forces;
  }

 private:
  // Distributes a traction in N/mm2, or a heat flux in W/mm2, over a side.
  void share(const OuterSide& side, Vec3 traction) {
    for (const NodeShare& here : side_shares(mesh_, side)) at_[here.node] = at_[here.node] + here.share * traction;
  }

  const MeshView& mesh_;
  std::vector<Vec3> at_;
};

// Returns the displacements of the six rigid motions at a node's degree of freedom: three translations along the axes,
// three rotations about the point.
std::array<double, 6> rigid_moves(Vec3 from_center, uint8_t axis) {
  const Vec3 r = from_center;
  std::array<double, 6> moves{};
  moves[axis] = 1;
  const std::array<Vec3, 3> turns{{{0, -r.z, r.y}, {r.z, 0, -r.x}, {-r.y, r.x, 0}}};
  for (size_t n = 0; n < 3; ++n) moves[3 + n] = turns[n][axis];
  return moves;
}

// True if the held degrees of freedom of a piece prevent all rigid motions. Eliminates with pivots.
bool is_held(std::array<std::array<double, 6>, 6> products) {
  constexpr double least_pivot = 1e-9;
  std::array<double, 6> scale{};
  for (size_t n = 0; n < 6; ++n) scale[n] = products[n][n];
  const double largest = *std::ranges::max_element(scale);
  std::array<bool, 6> used{};
  for (size_t round = 0; round < 6; ++round) {
    size_t pivot = 6;
    for (size_t n = 0; n < 6; ++n)
      if (!used[n] && (pivot == 6 || products[n][n] > products[pivot][pivot])) pivot = n;
    if (!(products[pivot][pivot] > least_pivot * largest)) return false;
    used[pivot] = true;
    for (size_t a = 0; a < 6; ++a) {
      if (used[a]) continue;
      const double factor = products[a][pivot] / products[pivot][pivot];
      for (size_t b = 0; b < 6; ++b) products[a][b] -= factor * products[pivot][b];
    }
  }
  return true;
}

// The pieces of a mesh, each with its first element.
struct Pieces {
  std::vector<uint32_t> of_node;
  std::vector<size_t> first;

  explicit Pieces(const MeshView& mesh) : of_node(mesh.node_count()) {
    const std::vector<uint32_t> of_element = pieces_of(mesh);
    for (size_t n = 0; n < of_element.size(); ++n) {
      if (of_element[n] == first.size()) first.push_back(n);
      for (const uint32_t node : mesh.nodes(n)) of_node[node] = of_element[n];
    }
  }
};

struct LooseWords {
  std::string one, many, hint;
};

// Reports an error when some pieces are not held.
void report_loose(const Study& study, const MeshView& mesh, const Pieces& pieces, const std::vector<bool>& is_fixed,
                  const LooseWords& words, Diagnostics& diagnostics) {
  const auto loose = static_cast<size_t>(std::ranges::count(is_fixed, false));
  if (loose == 0) return;
  const auto example = static_cast<size_t>(std::ranges::find(is_fixed, false) - is_fixed.begin());
  const std::string place = format_point(mesh.centroid(pieces.first[example]));
  const bool is_one = is_fixed.size() == 1;
  diagnostics.error(study.where,
                    is_one ? words.one
                           : format_count(loose) + " of the mesh's " + format_count(is_fixed.size()) + " pieces " +
                                 words.many + ", for example the one at " + place,
                    is_one ? words.hint : "support each, or choose smaller elements, so that they hang together");
}

// Checks that each piece of the mesh is held by supports of its own.
void check_held(const Study& study, const MeshView& mesh, const Conditions& conditions, Diagnostics& diagnostics) {
  const Pieces pieces(mesh);
  std::vector<std::array<std::array<double, 6>, 6>> products(pieces.first.size());
  // Lengths are measured in elements, so that translations and rotations are of similar size.
  const double per_mm = 1 / mesh.typical_size_mm();
  for (const Prescribed& here : conditions.displacements) {
    const uint32_t piece = pieces.of_node[here.node];
    const auto moves = rigid_moves(per_mm * (mesh.node(here.node) - mesh.centroid(pieces.first[piece])), here.axis);
    for (size_t a = 0; a < 6; ++a)
      for (size_t b = 0; b < 6; ++b) products[piece][a][b] += moves[a] * moves[b];
  }
  std::vector<bool> is_fixed;
  for (const auto& product : products) is_fixed.push_back(is_held(product));
  report_loose(study, mesh, pieces, is_fixed,
               {"the supports leave the part free to move or turn as a whole", "may move or turn as a whole",
                "hold more of it, for example {\"on\": \"zmin\", \"fix\": \"xyz\"}"},
               diagnostics);
}

// Checks that each piece has a prescribed value or a medium somewhere.
void check_decided(const Study& study, const MeshView& mesh, const Conditions& conditions, Diagnostics& diagnostics) {
  const Pieces pieces(mesh);
  std::vector<bool> is_fixed(pieces.first.size());
  for (const Prescribed& here : conditions.displacements) is_fixed[pieces.of_node[here.node]] = true;
  for (const Film& film : conditions.films) is_fixed[pieces.of_node[side_nodes(mesh, film.side)[0]]] = true;
  const PhysicsWords& words = words_of(study.physics);
  report_loose(study, mesh, pieces, is_fixed,
               {"nothing decides the " + words.potential.name, "have no " + words.potential.name + " anywhere",
                "add a support, for example {\"on\": \"zmin\", \"" + words.potential.member +
                    "\": " + words.usual_potential + "}"},
               diagnostics);
}

class ConditionMaker {
 public:
  ConditionMaker(const Study& study, const ModelView& model, Diagnostics& diagnostics, const ChooseNodes& choose)
      : study_(study),
        model_(model),
        diagnostics_(diagnostics),
        selector_(model, choose, diagnostics),
        forces_(model.mesh) {}

  std::optional<Conditions> make() {
    const size_t errors = diagnostics_.error_count();
    made_.physics = study_.physics;
    for (const Support& support : study_.supports) add_support(support);
    for (const auto& [place, value] : held_) made_.displacements.push_back({place.first, place.second, value});
    for (const Load& load : study_.loads) add_load(load);
    if (study_.gravity_mm_s2 != Vec3{}) forces_.add_weight(model_, study_.gravity_mm_s2);
    made_.forces = forces_.list();
    if (diagnostics_.error_count() > errors) return std::nullopt;
    if (study_.physics == Physics::mechanics)
      check_held(study_, model_.mesh, made_, diagnostics_);
    else
      check_decided(study_, model_.mesh, made_, diagnostics_);
    if (diagnostics_.error_count() > errors) return std::nullopt;
    return std::move(made_);
  }

 private:
  void add_support(const Support& support) {
    const std::vector<uint32_t> nodes = selector_.choose(support.on).list();
    for (const uint32_t n : nodes) {
      if (study_.physics != Physics::mechanics) held_[{n, uint8_t{0}}] = support.value;
      for (uint8_t axis = 0; axis < 3; ++axis)
        if (const auto value = support.displacement_mm[axis]) held_[{n, axis}] = *value;
    }
    made_.sets.push_back({support.name, nodes});
  }

  void add_load(const Load& load) {
    const size_t errors = diagnostics_.error_count();
    const Chosen chosen = selector_.choose(load.on);
    made_.sets.push_back({load.name, chosen.list()});
    const bool needs_sides =
        load.kind == Load::Kind::pressure || load.kind == Load::Kind::flux || load.kind == Load::Kind::convection;
    if (needs_sides && chosen.sides.empty()) {
      if (diagnostics_.error_count() == errors)
        diagnostics_.error(
            load.on.where,
            std::string("no outer face of the mesh lies there, and a ") + name_of(load.kind) + " needs one",
            "make the box as thick as an element, or name a side");
      return;
    }
    switch (load.kind) {
      case Load::Kind::force:
        return forces_.add(chosen, load.force_n);
      case Load::Kind::pressure:
        return forces_.add_pressure(chosen, load.pressure_mpa);
      case Load::Kind::flow:
        return forces_.add(chosen, {load.flow, 0, 0});
      case Load::Kind::flux:
        return forces_.add_flux(chosen, load.flow);
      case Load::Kind::convection:
        for (const OuterSide& side : chosen.sides) made_.films.push_back({side, load.film_w_m2k, load.ambient_c});
    }
  }

  static const char* name_of(Load::Kind kind) {
    if (kind == Load::Kind::pressure) return "pressure";
    return kind == Load::Kind::flux ? "flux" : "film";
  }

  const Study& study_;
  const ModelView& model_;
  Diagnostics& diagnostics_;
  Selector selector_;
  NodeForces forces_;
  Conditions made_;
  std::map<std::pair<uint32_t, uint8_t>, double> held_;  // the last of several values counts
};

}  // namespace

std::optional<Conditions> conditions_of(const Study& study, const ModelView& model, Diagnostics& diagnostics,
                                        const ChooseNodes& choose) {
  return ConditionMaker(study, model, diagnostics, choose).make();
}

}  // namespace ombre::fea
