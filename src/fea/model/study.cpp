// Reads studies.
#include "fea/model/study.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::fea {
namespace {

constexpr std::array<const char*, 6> side_names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
constexpr double tonne_mm3_of_kg_m3 = 1e-12;
constexpr double usual_facing_degrees = 30;

const char* const selection_help =
    "write \"zmin\" or another side, or {\"box\": [x0, y0, z0, x1, y1, z1]} in mm, {\"plane\": [x, y, z, nx, ny, nz]}, "
    "{\"facing\": [0, 0, 1]}, {\"material\": \"red\"}, {\"part\": \"arm\"} or {\"where\": \"z > 9 && x < 2\"}";

// The names that each physics has for its numbers.
struct Words {
  const char *conductivity, *unknown, *flow, *flux;
};
Words words_of(Physics physics) {
  if (physics == Physics::electric) return {"conductivity_s_m", "potential_v", "current_a", "current_a_mm2"};
  return {"conductivity_w_mk", "temperature_c", "heat_w", "flux_w_mm2"};
}

const Data* member_of(const DataMembers& members, std::string_view name) {
  const auto found = std::ranges::find(members, name, &std::pair<std::string, Data>::first);
  return found == members.end() ? nullptr : &found->second;
}

class StudyReader {
 public:
  explicit StudyReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Study read(const Data& data) {
    Study study;
    study.where = data.where;
    if (!members(data, "a study", {"physics", "materials", "supports", "loads", "gravity_mm_s2", "mean_strain"}))
      return study;
    if (const Data* physics = data.find("physics")) read_physics(*physics);
    study.physics = physics_;
    if (const Data* materials = data.find("materials")) read_materials(*materials, study);
    for (const Data& support : list(data, "supports")) study.supports.push_back(read_support(support));
    for (const Data& load : list(data, "loads")) study.loads.push_back(read_load(load));
    if (const Data* gravity = data.find("gravity_mm_s2")) study.gravity_mm_s2 = read_gravity(*gravity);
    if (const Data* strain = data.find("mean_strain")) study.mean_strain = read_strain(*strain, data);
    return study;
  }

 private:
  void fail(const Data& data, const std::string& expected, const std::string& hint = "") {
    diagnostics_.error(data.where, "expected " + expected + ", not " + describe(data), hint);
  }

  // True if an object has no other members than these; otherwise a diagnostic says so.
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

  std::string read_text(const Data& data, const std::string& what) {
    if (const std::string* text = data.string(); text && !text->empty()) return *text;
    fail(data, what);
    return "";
  }

  template <size_t count>
  std::array<double, count> read_numbers(const Data& data, const std::string& name, const std::string& hint) {
    std::array<double, count> numbers{};
    const DataList* items = data.list();
    if (!items || items->size() != count)
      fail(data, std::to_string(count) + " numbers for " + name, hint);
    else
      for (size_t n = 0; n < count; ++n) numbers[n] = read_number((*items)[n], name);
    return numbers;
  }

  Vec3 read_vector(const Data& data, const std::string& name) {
    const auto v = read_numbers<3>(data, name, "write [x, y, z]");
    return {v[0], v[1], v[2]};
  }

  // Returns a direction of length one.
  Vec3 read_direction(const Data& data, Vec3 v) {
    if (length(v) > 0) return (1 / length(v)) * v;
    diagnostics_.error(data.where, "the direction is of no length", "write for example [0, 0, 1]");
    return {0, 0, 1};
  }

  std::array<double, 6> read_strain(const Data& strain, const Data& study) {
    if (physics_ != Physics::mechanics)
      diagnostics_.error(strain.where, "a mean strain is of mechanics", "ombre homogenise gives conductivities");
    for (const char* other : {"supports", "loads", "gravity_mm_s2"})
      if (const Data* found = study.find(other))
        diagnostics_.error(found->where, std::string("a cell that repeats has no ") + other,
                           "leave it out: \"mean_strain\" says how the cell is deformed");
    return read_numbers<6>(strain, "mean_strain", "write [xx, yy, zz, xy, yz, zx], for example [0.01, 0, 0, 0, 0, 0]");
  }

  Vec3 read_gravity(const Data& data) {
    if (physics_ != Physics::mechanics)
      diagnostics_.error(data.where, "gravity does nothing in conduction", "leave it out");
    return read_vector(data, "gravity_mm_s2");
  }

  void read_physics(const Data& data) {
    constexpr std::array<std::pair<const char*, Physics>, 3> names{
        {{"mechanics", Physics::mechanics}, {"heat", Physics::heat}, {"electric", Physics::electric}}};
    const std::string name = read_text(data, "\"mechanics\", \"heat\" or \"electric\"");
    for (const auto& [known, physics] : names)
      if (name == known) {
        physics_ = physics;
        return;
      }
    if (!name.empty())
      diagnostics_.error(data.where, "there is no physics \"" + name + "\"",
                         "write \"mechanics\", \"heat\" or \"electric\"");
  }

  void read_materials(const Data& data, Study& study) {
    if (!data.members()) return fail(data, "materials by their names, in braces");
    for (const auto& [name, value] : *data.members()) {
      if (!members(value, "a material",
                   {"modulus_mpa", "poissons_ratio", "density_kg_m3", "conductivity_w_mk", "conductivity_s_m"}))
        continue;
      if (physics_ != Physics::mechanics) {
        if (const auto conductivity = read_conductivity(*value.members(), physics_, diagnostics_))
          study.conductivities[to_lower(name)] = *conductivity;
        continue;
      }
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
    if (data->string()) {
      selection.side = read_side(*data);
      return selection;
    }
    if (!data->members() || data->members()->empty()) {
      fail(*data, "a side or a box", selection_help);
      return selection;
    }
    if (!members(*data, "a selection",
                 {"side", "box", "plane", "facing", "within_degrees", "material", "part", "where"}))
      return selection;
    for (const auto& [name, value] : *data->members()) read_choice(name, value, selection);
    if (const Data* within = data->find("within_degrees")) read_within(*within, selection);
    return selection;
  }

  std::pair<int, bool> read_side(const Data& data) {
    const std::string name = read_text(data, "a side");
    const auto side = std::ranges::find(side_names, to_lower(name));
    if (side == side_names.end())
      diagnostics_.error(data.where, "there is no side \"" + name + "\"",
                         "the sides are xmin, xmax, ymin, ymax, zmin and zmax");
    const auto number = static_cast<int>(side - side_names.begin());
    return {number / 2, number % 2 == 1};
  }

  void read_choice(const std::string& name, const Data& data, Selection& selection) {
    if (name == "side") selection.side = read_side(data);
    if (name == "box") selection.box = read_box(data);
    if (name == "plane") {
      const auto v = read_numbers<6>(data, "plane", "write [x, y, z, nx, ny, nz]: a point, and what is perpendicular");
      selection.plane = {{v[0], v[1], v[2]}, read_direction(data, {v[3], v[4], v[5]})};
    }
    if (name == "facing") selection.facing = {read_direction(data, read_vector(data, name)), usual_facing_degrees};
    if (name == "material") selection.material = {read_text(data, "a material's name"), data.where};
    if (name == "part") selection.part = {read_text(data, "a part's name"), data.where};
    if (name == "where") selection.formula = {read_text(data, "a formula such as \"z > 9 && x < 2\""), data.where};
  }

  Box read_box(const Data& data) {
    const auto ends = read_numbers<6>(data, "box", "write [x0, y0, z0, x1, y1, z1]");
    const Box box{{ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}};
    if (box.is_empty()) diagnostics_.error(data.where, "the box is empty", "write its corner of least x, y, z first");
    return box;
  }

  void read_within(const Data& data, Selection& selection) {
    const double degrees = read_number(data, "within_degrees");
    if (!selection.facing)
      diagnostics_.error(data.where, "\"within_degrees\" needs \"facing\"", "write \"facing\": [0, 0, 1]");
    else if (!(degrees > 0 && degrees <= 180))
      diagnostics_.error(data.where, "within_degrees is out of its range", "write a number above 0, up to 180");
    else
      selection.facing->most_degrees = degrees;
  }

  std::string read_name(const Data& data, const std::string& usual) {
    const Data* name = data.find("name");
    return name ? read_text(*name, "a name") : usual;
  }

  Support read_support(const Data& data) {
    Support support;
    const Words words = words_of(physics_);
    const bool is_mechanics = physics_ == Physics::mechanics;
    const std::vector<std::string> known = is_mechanics
                                               ? std::vector<std::string>{"on", "fix", "displacement_mm", "name"}
                                               : std::vector<std::string>{"on", words.unknown, "name"};
    if (!members(data, "a support", known)) return support;
    support.on = read_selection(data);
    support.name = read_name(data, "support_" + std::to_string(++supports_));
    if (!is_mechanics) {
      if (const Data* value = data.find(words.unknown))
        support.value = read_number(*value, words.unknown);
      else
        diagnostics_.error(data.where, std::string("\"") + words.unknown + "\" is missing",
                           std::string("write \"") + words.unknown + "\": 20");
      return support;
    }
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
    if (physics_ != Physics::mechanics) return read_flow(data);
    Load load;
    if (!members(data, "a load", {"on", "force_n", "pressure_mpa", "name"})) return load;
    load.on = read_selection(data);
    load.name = read_name(data, "load_" + std::to_string(++loads_));
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

  Load read_flow(const Data& data) {
    Load load;
    const Words words = words_of(physics_);
    const bool is_heat = physics_ == Physics::heat;
    std::vector<std::string> known{"on", words.flow, words.flux, "name"};
    if (is_heat) known.insert(known.end(), {"film_w_m2k", "ambient_c"});
    if (!members(data, "a load", known)) return load;
    load.on = read_selection(data);
    load.name = read_name(data, "load_" + std::to_string(++loads_));
    const Data *flow = data.find(words.flow), *flux = data.find(words.flux), *film = data.find("film_w_m2k");
    if ((flow ? 1 : 0) + (flux ? 1 : 0) + (film ? 1 : 0) != 1) {
      diagnostics_.error(data.where, "a load has one of " + join(known, ", ") + " beside \"on\" and its name",
                         std::string("write \"") + words.flow + "\": 1");
      return load;
    }
    if (flow) load.kind = Load::Kind::flow, load.flow = read_number(*flow, words.flow);
    if (flux) load.kind = Load::Kind::flux, load.flow = read_number(*flux, words.flux);
    if (film) read_film(data, *film, load);
    return load;
  }

  void read_film(const Data& data, const Data& film, Load& load) {
    load.kind = Load::Kind::convection;
    load.film_w_m2k = read_number(film, "film_w_m2k");
    if (!(load.film_w_m2k > 0)) diagnostics_.error(film.where, "film_w_m2k must be above 0", "write for example 10");
    if (const Data* ambient = data.find("ambient_c"))
      load.ambient_c = read_number(*ambient, "ambient_c");
    else
      diagnostics_.error(data.where, "\"ambient_c\" is missing, the temperature around", "write \"ambient_c\": 20");
  }

  Diagnostics& diagnostics_;
  Physics physics_ = Physics::mechanics;
  size_t supports_ = 0, loads_ = 0;
};

}  // namespace

std::optional<Study> read_study(const Data& data, Diagnostics& diagnostics) {
  const size_t errors = diagnostics.error_count();
  Study study = StudyReader(diagnostics).read(data);
  if (diagnostics.error_count() > errors) return std::nullopt;
  return study;
}

std::optional<Elastic> read_elastic(const DataMembers& members, const SourceRange& where, Diagnostics& diagnostics) {
  const Data *modulus = member_of(members, "modulus_mpa"), *ratio = member_of(members, "poissons_ratio"),
             *density = member_of(members, "density_kg_m3");
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

std::optional<double> read_conductivity(const DataMembers& members, Physics physics, Diagnostics& diagnostics) {
  const char* const name = words_of(physics).conductivity;
  const Data* data = member_of(members, name);
  if (!data) return std::nullopt;
  const double* number = data->number();
  if (number && *number >= 1e-12 && *number <= 1e12) return *number;
  diagnostics.error(data->where, std::string(name) + " is out of its range", "write a number above 0, for example 0.2");
  return 1.0;
}

}  // namespace ombre::fea
