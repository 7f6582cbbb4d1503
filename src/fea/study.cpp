#include "fea/study.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/text.h"

namespace ombre::fea {
namespace {

constexpr std::array<const char*, 6> side_names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
constexpr double tonne_mm3_of_kg_m3 = 1e-12;
// A node counts as inside of a box if it lies no farther out than this share of a brick.
constexpr double slack_of_brick = 1e-6;

const char* const selection_help = "write \"zmin\" or another side, or {\"box\": [x0, y0, z0, x1, y1, z1]} in mm";

class StudyReader {
 public:
  explicit StudyReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Study read(const Data& data) {
    Study study;
    study.where = data.where;
    if (!members(data, "a study", {"materials", "supports", "loads", "gravity_mm_s2"})) return study;
    if (const Data* materials = data.find("materials")) read_materials(*materials, study);
    for (const Data& support : list(data, "supports")) study.supports.push_back(read_support(support));
    for (const Data& load : list(data, "loads")) study.loads.push_back(read_load(load));
    if (const Data* gravity = data.find("gravity_mm_s2")) study.gravity_mm_s2 = read_vector(*gravity, "gravity_mm_s2");
    return study;
  }

 private:
  void fail(const Data& data, const std::string& expected, const std::string& hint = "") {
    diagnostics_.error(data.where, "expected " + expected + ", not " + describe(data), hint);
  }

  // Are these the only members of an object? Else a diagnostic says so.
  bool members(const Data& data, const std::string& what, const std::vector<std::string>& known) {
    if (!data.members()) {
      fail(data, what + " in braces", "its members are " + join(known, ", "));
      return false;
    }
    for (const auto& [name, value] : *data.members()) {
      if (std::ranges::find(known, name) != known.end()) continue;
      const std::string slip = did_you_mean(name, known);
      diagnostics_.error(value.where, std::string(what).append(" has no \"").append(name).append("\""),
                         slip.empty() ? "it has " + join(known, ", ") : slip);
      return false;
    }
    return true;
  }

  DataList list(const Data& data, const char* name) {
    const Data* found = data.find(name);
    if (!found) return {};
    if (const DataList* items = found->list()) return *items;
    fail(*found, std::string("a list of ") + name);
    return {};
  }

  double read_number(const Data& data, const std::string& name) {
    if (const double* number = data.number(); number && std::isfinite(*number)) return *number;
    fail(data, "a number for " + name);
    return 0;
  }

  Vec3 read_vector(const Data& data, const std::string& name) {
    const DataList* items = data.list();
    if (!items || items->size() != 3) {
      fail(data, "three numbers for " + name, "write [x, y, z]");
      return {};
    }
    return {read_number((*items)[0], name), read_number((*items)[1], name), read_number((*items)[2], name)};
  }

  void read_materials(const Data& data, Study& study) {
    if (!data.members()) return fail(data, "materials by their names, in braces");
    for (const auto& [name, value] : *data.members()) {
      if (!members(value, "a material", {"modulus_mpa", "poissons_ratio", "density_kg_m3"})) continue;
      if (const auto elastic = read_elastic(*value.members(), value.where, diagnostics_))
        study.materials[to_lower(name)] = *elastic;
      else
        fail(value, "properties of \"" + name + "\"",
             "write for example {\"modulus_mpa\": 2850, \"poissons_ratio\": 0.39}");
    }
  }

  Selection read_selection(const Data& owner) {
    Selection selection;
    selection.where = owner.where;
    const Data* data = owner.find("on");
    if (!data) {
      diagnostics_.error(owner.where, "\"on\" is missing, which says where", selection_help);
      return selection;
    }
    selection.where = data->where;
    if (const std::string* name = data->string()) {
      const auto side = std::ranges::find(side_names, to_lower(*name));
      if (side == side_names.end())
        diagnostics_.error(data->where, "there is no side \"" + *name + "\"",
                           "the sides are xmin, xmax, ymin, ymax, zmin and zmax");
      const auto number = static_cast<int>(side - side_names.begin());
      selection.side = {number / 2, number % 2 == 1};
      return selection;
    }
    const Data* box = data->find("box");
    if (!box || !box->list() || box->list()->size() != 6) {
      fail(*data, "a side or a box", selection_help);
      return selection;
    }
    std::array<double, 6> ends{};
    for (size_t n = 0; n < 6; ++n) ends[n] = read_number((*box->list())[n], "box");
    selection.box = {{ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}};
    if (selection.box.is_empty())
      diagnostics_.error(box->where, "the box is empty", "write its corner of least x, y, z first");
    return selection;
  }

  Support read_support(const Data& data) {
    Support support;
    if (!members(data, "a support", {"on", "fix", "displacement_mm"})) return support;
    support.on = read_selection(data);
    const Data *fix = data.find("fix"), *displacement = data.find("displacement_mm");
    if (!fix == !displacement) {
      diagnostics_.error(data.where,
                         fix ? "a support has \"fix\" or \"displacement_mm\", not both"
                             : "a support says neither what it fixes nor how far it moves it",
                         "write \"fix\": \"xyz\", or \"displacement_mm\": [null, null, -1]");
      return support;
    }
    if (fix)
      read_fix(*fix, support);
    else
      read_displacement(*displacement, support);
    return support;
  }

  void read_fix(const Data& data, Support& support) {
    const std::string axes = "xyz", text = data.string() ? to_lower(*data.string()) : "";
    if (text.empty() || text.find_first_not_of(axes) != std::string::npos)
      return fail(data, "axes", "write \"xyz\", or those that are held");
    for (const char axis : text) support.displacement_mm[axes.find(axis)] = 0;
  }

  void read_displacement(const Data& data, Support& support) {
    const DataList* items = data.list();
    if (!items || items->size() != 3)
      return fail(data, "three displacements", "write [x, y, z] in mm, null where it is free");
    for (size_t axis = 0; axis < 3; ++axis)
      if (!(*items)[axis].is_null()) support.displacement_mm[axis] = read_number((*items)[axis], "displacement_mm");
  }

  Load read_load(const Data& data) {
    Load load;
    if (!members(data, "a load", {"on", "force_n", "pressure_mpa"})) return load;
    load.on = read_selection(data);
    const Data *force = data.find("force_n"), *pressure = data.find("pressure_mpa");
    if (!force == !pressure) {
      diagnostics_.error(data.where, "a load is either a force or a pressure",
                         "write \"force_n\": [0, 0, -10], or \"pressure_mpa\": 0.1");
      return load;
    }
    if (force) load.force_n = read_vector(*force, "force_n");
    if (pressure) {
      load.kind = Load::Kind::pressure;
      load.pressure_mpa = read_number(*pressure, "pressure_mpa");
    }
    return load;
  }

  Diagnostics& diagnostics_;
};

// Finds the nodes of a selection; a diagnostic when there are none.
class Selector {
 public:
  Selector(const Bricks& bricks, Diagnostics& diagnostics) : bricks_(bricks), diagnostics_(diagnostics) {
    least_ = most_ = bricks.corners.front();
    for (const Cell& corner : bricks.corners)
      for (size_t axis = 0; axis < 3; ++axis) {
        least_[axis] = std::min(least_[axis], corner[axis]);
        most_[axis] = std::max(most_[axis], corner[axis]);
      }
  }

  std::vector<bool> nodes(const Selection& selection) {
    std::vector<bool> chosen(bricks_.node_count());
    for (size_t n = 0; n < chosen.size(); ++n) chosen[n] = holds(selection, n);
    if (std::ranges::find(chosen, true) == chosen.end())
      diagnostics_.error(selection.where, "no node of the mesh lies in this box",
                         "the mesh lies from " + text(least_) + " to " + text(most_) + " mm");
    return chosen;
  }

 private:
  bool holds(const Selection& selection, size_t n) const {
    const Cell& corner = bricks_.corners[n];
    if (selection.side) {
      const auto axis = static_cast<size_t>(selection.side->first);
      return corner[axis] == (selection.side->second ? most_ : least_)[axis];
    }
    const double slack = slack_of_brick * std::min({bricks_.size_mm.x, bricks_.size_mm.y, bricks_.size_mm.z});
    return selection.box.expanded(slack).contains(bricks_.node(n));
  }

  std::string text(const Cell& corner) const {
    std::vector<std::string> parts;
    for (int axis = 0; axis < 3; ++axis)
      parts.push_back(format_rounded(bricks_.origin[axis] + corner[static_cast<size_t>(axis)] * bricks_.size_mm[axis]));
    return "(" + join(parts, ", ") + ")";
  }

  const Bricks& bricks_;
  Diagnostics& diagnostics_;
  Cell least_{}, most_{};
};

// Forces at all nodes.
class Forces {
 public:
  explicit Forces(const Bricks& bricks) : bricks_(bricks), at_(bricks.node_count()) {}

  // Over the outer faces whose corners are all chosen, by their areas; without any, evenly over the nodes.
  void add_force(const std::vector<bool>& chosen, Vec3 force) {
    const std::vector<OuterFace> faces = faces_of(chosen);
    double area = 0;
    for (const OuterFace& face : faces) area += face_area_mm2(bricks_, face);
    for (const OuterFace& face : faces) share(face_nodes(bricks_, face), (face_area_mm2(bricks_, face) / area) * force);
    if (!faces.empty()) return;
    const auto count = static_cast<double>(std::ranges::count(chosen, true));
    for (size_t n = 0; n < chosen.size(); ++n)
      if (chosen[n]) at_[n] = at_[n] + (1 / count) * force;
  }

  // False when no face is chosen.
  bool add_pressure(const std::vector<bool>& chosen, double pressure) {
    const std::vector<OuterFace> faces = faces_of(chosen);
    for (const OuterFace& face : faces) {
      Vec3 force;
      force[face.axis] = (face.is_upper ? -1 : 1) * pressure * face_area_mm2(bricks_, face);
      share(face_nodes(bricks_, face), force);
    }
    return !faces.empty();
  }

  void add_weight(const Model& model, Vec3 gravity) {
    for (size_t n = 0; n < bricks_.count(); ++n)
      share(bricks_.nodes[n], (model.elastic(n).density_t_mm3 * bricks_.volume_mm3()) * gravity);
  }

  std::vector<Prescribed> list() const {
    std::vector<Prescribed> forces;
    for (uint32_t n = 0; n < at_.size(); ++n)
      for (uint8_t axis = 0; axis < 3; ++axis)
        if (at_[n][axis] != 0) forces.push_back({n, axis, at_[n][axis]});
    return forces;
  }

 private:
  std::vector<OuterFace> faces_of(const std::vector<bool>& chosen) {
    if (faces_.empty()) faces_ = outer_faces(bricks_);
    std::vector<OuterFace> faces;
    for (const OuterFace& face : faces_)
      if (std::ranges::all_of(face_nodes(bricks_, face), [&](uint32_t n) { return chosen[n]; })) faces.push_back(face);
    return faces;
  }

  template <size_t count>
  void share(const std::array<uint32_t, count>& nodes, Vec3 force) {
    for (const uint32_t n : nodes) at_[n] = at_[n] + (1.0 / count) * force;
  }

  const Bricks& bricks_;
  std::vector<Vec3> at_;
  std::vector<OuterFace> faces_;  // all, once they are needed
};

// The moves of a rigid body at a node's degree of freedom: three along the axes, three turns about the point.
std::array<double, 6> rigid_moves(Vec3 from_center, uint8_t axis) {
  const Vec3 r = from_center;
  std::array<double, 6> moves{};
  moves[axis] = 1;
  const std::array<Vec3, 3> turns{{{0, -r.z, r.y}, {r.z, 0, -r.x}, {-r.y, r.x, 0}}};
  for (size_t n = 0; n < 3; ++n) moves[3 + n] = turns[n][axis];
  return moves;
}

// Do the held degrees of freedom of a piece leave no move of a rigid body? By elimination with pivots.
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

// Each piece of the mesh must be held by its own supports.
void check_pieces(const Study& study, const Model& model, const std::vector<Prescribed>& held,
                  Diagnostics& diagnostics) {
  const std::vector<uint32_t> pieces = pieces_of(model.bricks);
  const uint32_t count = *std::ranges::max_element(pieces) + 1;
  std::vector<uint32_t> piece_of_node(model.bricks.node_count());
  std::vector<size_t> first(count, model.bricks.count());
  for (size_t n = 0; n < pieces.size(); ++n) {
    first[pieces[n]] = std::min(first[pieces[n]], n);
    for (const uint32_t node : model.bricks.nodes[n]) piece_of_node[node] = pieces[n];
  }
  std::vector<std::array<std::array<double, 6>, 6>> products(count);
  for (const Prescribed& here : held) {
    const uint32_t piece = piece_of_node[here.node];
    // Lengths in bricks, so that moves and turns are of one size.
    const Vec3 away =
        (1 / model.bricks.size_mm.x) * (model.bricks.node(here.node) - model.bricks.centroid(first[piece]));
    const auto moves = rigid_moves(away, here.axis);
    for (size_t a = 0; a < 6; ++a)
      for (size_t b = 0; b < 6; ++b) products[piece][a][b] += moves[a] * moves[b];
  }
  size_t loose = 0, example = 0;
  for (uint32_t piece = 0; piece < count; ++piece)
    if (!is_held(products[piece]) && ++loose == 1) example = first[piece];
  if (loose == 0) return;
  const Vec3 at = model.bricks.centroid(example);
  const std::string place =
      "(" + format_rounded(at.x) + ", " + format_rounded(at.y) + ", " + format_rounded(at.z) + ")";
  diagnostics.error(study.where,
                    count == 1 ? "the supports leave the part free to move or turn as a whole"
                               : format_count(loose) + " of the mesh's " + format_count(count) +
                                     " pieces may move or turn as a whole, for example the one at " + place,
                    count == 1 ? "hold more of it, for example {\"on\": \"zmin\", \"fix\": \"xyz\"}"
                               : "support each, or choose smaller bricks, so that they hang together");
}

}  // namespace

std::optional<Study> read_study(const Data& data, Diagnostics& diagnostics) {
  const size_t errors = diagnostics.error_count();
  Study study = StudyReader(diagnostics).read(data);
  if (diagnostics.error_count() > errors) return std::nullopt;
  return study;
}

std::optional<Elastic> read_elastic(const DataMembers& members, const SourceRange& where, Diagnostics& diagnostics) {
  const auto find = [&](std::string_view name) -> const Data* {
    const auto found = std::ranges::find(members, name, &std::pair<std::string, Data>::first);
    return found == members.end() ? nullptr : &found->second;
  };
  const Data *modulus = find("modulus_mpa"), *ratio = find("poissons_ratio"), *density = find("density_kg_m3");
  if (!modulus && !ratio && !density) return std::nullopt;
  const auto check = [&](const Data* data, const char* name, double least, double most, const std::string& hint) {
    const double* number = data ? data->number() : nullptr;
    if (number && *number >= least && *number <= most) return *number;
    diagnostics.error(data ? data->where : where,
                      data ? std::string(name) + " is out of its range" : std::string(name) + " is missing", hint);
    return 1.0;
  };
  Elastic elastic;
  elastic.modulus_mpa = check(modulus, "modulus_mpa", 1e-9, 1e9, "write Young's modulus in MPa, for example 2850");
  elastic.poissons_ratio =
      check(ratio, "poissons_ratio", -0.99, 0.5, "write a number from -0.99 to 0.5, for example 0.39");
  if (density)
    elastic.density_t_mm3 =
        tonne_mm3_of_kg_m3 * check(density, "density_kg_m3", 0, 1e6, "write the density in kg/m3, for example 1180");
  return elastic;
}

std::optional<Conditions> conditions_of(const Study& study, const Model& model, Diagnostics& diagnostics) {
  const size_t errors = diagnostics.error_count();
  Selector selector(model.bricks, diagnostics);
  Conditions conditions;
  std::map<std::pair<uint32_t, uint8_t>, double> held;  // what is said last counts
  for (const Support& support : study.supports) {
    const std::vector<bool> chosen = selector.nodes(support.on);
    for (uint32_t n = 0; n < chosen.size(); ++n)
      for (uint8_t axis = 0; chosen[n] && axis < 3; ++axis)
        if (const auto value = support.displacement_mm[axis]) held[{n, axis}] = *value;
  }
  for (const auto& [place, value] : held) conditions.displacements.push_back({place.first, place.second, value});
  Forces forces(model.bricks);
  for (const Load& load : study.loads) {
    const std::vector<bool> chosen = selector.nodes(load.on);
    if (load.kind == Load::Kind::force)
      forces.add_force(chosen, load.force_n);
    else if (!forces.add_pressure(chosen, load.pressure_mpa) && diagnostics.error_count() == errors)
      diagnostics.error(load.on.where, "no outer face of the mesh lies there, and a pressure needs one",
                        "make the box as thick as a brick, or name a side");
  }
  if (study.gravity_mm_s2 != Vec3{}) forces.add_weight(model, study.gravity_mm_s2);
  conditions.forces = forces.list();
  if (diagnostics.error_count() > errors) return std::nullopt;
  check_pieces(study, model, conditions.displacements, diagnostics);
  if (diagnostics.error_count() > errors) return std::nullopt;
  return conditions;
}

}  // namespace ombre::fea
