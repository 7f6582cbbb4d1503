// Reads studies.
#include "fea/model/study.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::fea {

const char* const selection_help =
    "write \"zmin\" or another side, or {\"box\": [x0, y0, z0, x1, y1, z1]} in mm, {\"plane\": [x, y, z, nx, ny, nz]}, "
    "{\"facing\": [0, 0, 1]}, {\"material\": \"red\"}, {\"part\": \"arm\"} or {\"where\": \"z > 9 && x < 2\"}";

namespace {

const std::vector<std::string> side_names{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
constexpr double tonne_mm3_of_kg_m3 = 1e-12;
constexpr double usual_facing_degrees = 30;

std::optional<std::pair<int, bool>> read_side(const Data& data, const MemberReader& reader) {
  Data lower = data;
  if (data.string()) lower.value = to_lower(*data.string());
  const auto side = reader.choice(lower, "side", side_names);
  if (!side) return std::nullopt;
  return std::pair(static_cast<int>(*side) / 2, *side % 2 == 1);
}

std::optional<Vec3> direction_of(Vec3 v, const Data& data, const MemberReader& reader) {
  if (length(v) > 0) return (1 / length(v)) * v;
  reader.fail(data, "the direction is of no length", "write for example [0, 0, 1]");
  return std::nullopt;
}

std::optional<Plane> read_plane(const Data& data, const MemberReader& reader) {
  const auto v = reader.numbers(data, "plane", 6, "[x, y, z, nx, ny, nz]: a point, and what is perpendicular");
  if (!v) return std::nullopt;
  const auto normal = direction_of({(*v)[3], (*v)[4], (*v)[5]}, data, reader);
  if (!normal) return std::nullopt;
  return Plane{{(*v)[0], (*v)[1], (*v)[2]}, *normal};
}

std::optional<Facing> read_facing(const Data& data, const MemberReader& reader) {
  const auto direction = read_direction(data, reader);
  if (!direction) return std::nullopt;
  return Facing{*direction, usual_facing_degrees};
}

void read_within(Selection& selection, const Data& data, const MemberReader& reader) {
  const auto degrees = reader.number(data, "within_degrees", {0, 180, false, true});
  if (degrees && selection.facing) selection.facing->most_degrees = *degrees;
}

Field<Selection> placed_text(const std::string& name, std::optional<PlacedText> Selection::*member) {
  return field::value(name, member, [=](const Data& data, const MemberReader& reader) -> std::optional<PlacedText> {
    const auto text = reader.text(data, name);
    if (!text) return std::nullopt;
    return PlacedText{*text, data.where};
  });
}

const Record<Selection>& selection_record() {
  using S = Selection;
  static const Record<S> record =
      Record<S>("a selection",
                {field::value("side", &S::side, read_side), field::value("box", &S::box, read_box),
                 field::value("plane", &S::plane, read_plane), field::value("facing", &S::facing, read_facing),
                 field::special("within_degrees", read_within), placed_text("material", &S::material),
                 placed_text("part", &S::part), placed_text("where", &S::formula)})
          .checked([](S& selection, const Data& data, const MemberReader& reader) {
            if (const Data* within = data.find("within_degrees"); within && !selection.facing)
              reader.fail(*within, "\"within_degrees\" needs \"facing\"", "write \"facing\": [0, 0, 1]");
          });
  return record;
}

void read_fix(Support& support, const Data& data, const MemberReader& reader) {
  const std::string axes = "xyz", text = data.string() ? to_lower(*data.string()) : "";
  if (text.empty() || text.find_first_not_of(axes) != std::string::npos)
    return reader.fail_expected(data, "axes", "write \"xyz\", or those that are held");
  for (const char axis : text) support.displacement_mm[axes.find(axis)] = 0;
}

void read_displacement(Support& support, const Data& data, const MemberReader& reader) {
  const DataList* const items = data.list();
  if (!items || items->size() != 3)
    return reader.fail_expected(data, "three displacements", "write [x, y, z] in mm, null where it is free");
  for (size_t axis = 0; axis < 3; ++axis)
    if (const Data& item = (*items)[axis]; !item.is_null())
      support.displacement_mm[axis] = reader.number(item, "displacement_mm");
}

// Returns the record of a support or a load with these members, its name, and where it acts.
template <class T>
Record<T> placed_record(const std::string& what, std::vector<Field<T>> fields) {
  fields.insert(fields.begin(), field::value("on", &T::on, read_selection).required(selection_help));
  fields.push_back(field::text("name", &T::name));
  return Record<T>(what, fields);
}

Record<Support> support_record(Physics physics) {
  using S = Support;
  if (physics == Physics::mechanics)
    return placed_record<S>("a support",
                            {field::special("fix", read_fix), field::special("displacement_mm", read_displacement)})
        .one_of({"fix", "displacement_mm"}, R"(write "fix": "xyz", or "displacement_mm": [null, null, -1])");
  const PhysicsWords& words = words_of(physics);
  const std::string example = "write \"" + words.potential.member + "\": " + words.usual_potential;
  return placed_record<S>("a support", {field::number(words.potential.member, &S::value).required(example)});
}

Record<Load> load_record(Physics physics) {
  using L = Load;
  if (physics == Physics::mechanics)
    return placed_record<L>("a load",
                            {field::numbers("force_n", &L::force_n, "[x, y, z]"),
                             field::number("pressure_mpa", &L::pressure_mpa).sets(&L::kind, L::Kind::pressure)})
        .one_of({"force_n", "pressure_mpa"}, R"(write "force_n": [0, 0, -10], or "pressure_mpa": 0.1)");
  const PhysicsWords& words = words_of(physics);
  std::vector<Field<L>> fields{field::number(words.flow.member, &L::flow).sets(&L::kind, L::Kind::flow),
                               field::number(words.flux.member, &L::flow).sets(&L::kind, L::Kind::flux)};
  std::vector<std::string> kinds{words.flow.member, words.flux.member};
  if (words.has_films) {
    fields.push_back(field::number("film_w_m2k", &L::film_w_m2k, above_zero).sets(&L::kind, L::Kind::convection));
    fields.push_back(field::number("ambient_c", &L::ambient_c));
    kinds.emplace_back("film_w_m2k");
  }
  return placed_record<L>("a load", fields)
      .one_of(kinds, "write \"" + words.flow.member + "\": 1")
      .checked([](L& load, const Data& data, const MemberReader& reader) {
        if (load.kind == L::Kind::convection && !data.find("ambient_c"))
          reader.fail_missing(data, "a film", "ambient_c", "write the temperature around, \"ambient_c\": 20");
      });
}

void read_density(Elastic& elastic, const Data& data, const MemberReader& reader) {
  if (const auto density = reader.number(data, "density_kg_m3", {0, 1e6}))
    elastic.density_t_mm3 = tonne_mm3_of_kg_m3 * *density;
}

const Record<Elastic>& elastic_record() {
  using E = Elastic;
  static const Record<E> record("a material", {field::number("modulus_mpa", &E::modulus_mpa, {1e-9, 1e9})
                                                   .required("write Young's modulus in MPa, for example 2850"),
                                               field::number("poissons_ratio", &E::poissons_ratio, {-0.99, 0.5})
                                                   .required("write a number from -0.99 to 0.5, for example 0.39"),
                                               field::special("density_kg_m3", read_density)});
  return record;
}

// A material may have these members in a study of whatever physics.
const std::vector<std::string>& material_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = elastic_record().names();
    for (const PhysicsWords& words : all_physics())
      if (!words.conductivity.member.empty()) all.push_back(words.conductivity.member);
    return all;
  }();
  return names;
}

void read_materials(Study& study, const Data& data, const MemberReader& reader) {
  const DataMembers* const materials = reader.named(data, "materials");
  if (!materials) return;
  for (const auto& [name, value] : *materials) {
    if (!reader.has_only(value, "a material", material_names())) continue;
    if (study.physics == Physics::mechanics)
      elastic_record().read_members(value, study.materials[to_lower(name)], reader);
    else if (const auto conductivity = read_conductivity(*value.members(), study.physics, reader.diagnostics()))
      study.conductivities[to_lower(name)] = *conductivity;
  }
}

void check_study(Study& study, const Data& data, const MemberReader& reader) {
  const Data *const gravity = data.find("gravity_mm_s2"), *const strain = data.find("mean_strain");
  const bool is_mechanics = study.physics == Physics::mechanics;
  if (gravity && !is_mechanics) reader.fail(*gravity, "gravity does nothing in conduction", "leave it out");
  if (strain && !is_mechanics)
    reader.fail(*strain, "a mean strain is of mechanics", "ombre homogenise gives conductivities");
  for (const char* other : {"supports", "loads", "gravity_mm_s2"})
    if (const Data* found = data.find(other); found && strain)
      reader.fail(*found, std::string("a cell that repeats has no ") + other,
                  "leave it out: \"mean_strain\" says how the cell is deformed");
}

// Supports and loads without names are numbered.
template <class Part>
void name_all(std::vector<Part>& parts, const std::string& what) {
  for (size_t n = 0; n < parts.size(); ++n)
    if (parts[n].name.empty()) parts[n].name = what + "_" + std::to_string(n + 1);
}

const Record<Study>& study_record() {
  using S = Study;
  static const Record<S> record =
      Record<S>(
          "a study",
          {field::choice("physics", &S::physics, names_in(all_physics())), field::special("materials", read_materials),
           field::objects("supports", &S::supports, [](const S& study) { return support_record(study.physics); }),
           field::objects("loads", &S::loads, [](const S& study) { return load_record(study.physics); }),
           field::numbers("gravity_mm_s2", &S::gravity_mm_s2, "[x, y, z]"),
           field::numbers("mean_strain", &S::mean_strain,
                          "[xx, yy, zz, xy, yz, zx], for example [0.01, 0, 0, 0, 0, 0]")})
          .checked(check_study);
  return record;
}

}  // namespace

std::optional<Vec3> read_direction(const Data& data, const MemberReader& reader) {
  const auto v = reader.numbers(data, "direction", 3, "[x, y, z]");
  return v ? direction_of({(*v)[0], (*v)[1], (*v)[2]}, data, reader) : std::nullopt;
}

std::optional<Box> read_box(const Data& data, const MemberReader& reader) {
  const auto ends = reader.numbers(data, "box", 6, "[x0, y0, z0, x1, y1, z1] in mm");
  if (!ends) return std::nullopt;
  const Box box{{(*ends)[0], (*ends)[1], (*ends)[2]}, {(*ends)[3], (*ends)[4], (*ends)[5]}};
  if (!box.is_empty()) return box;
  reader.fail(data, "the box is empty", "write its corner of least x, y, z first");
  return std::nullopt;
}

std::optional<Selection> read_selection(const Data& data, const MemberReader& reader) {
  Selection selection;
  selection.where = data.where;
  if (data.string())
    selection.side = read_side(data, reader);
  else if (data.members() && !data.members()->empty())
    selection_record().read(data, selection, reader);
  else
    reader.fail_expected(data, "a side or a box", selection_help);
  return selection;
}

std::optional<Study> read_study(const Data& data, Diagnostics& diagnostics) {
  Study study;
  if (!study_record().read(data, study, MemberReader(diagnostics))) return std::nullopt;
  name_all(study.supports, "support");
  name_all(study.loads, "load");
  return study;
}

std::optional<Elastic> read_elastic(const DataMembers& members, const SourceRange& where, Diagnostics& diagnostics) {
  const Data data(members, where);
  const auto is_there = [&](const std::string& name) { return data.find(name); };
  if (std::ranges::none_of(elastic_record().names(), is_there)) return std::nullopt;
  Elastic elastic{1, 0, 0};
  elastic_record().read_members(data, elastic, MemberReader(diagnostics));
  return elastic;
}

std::optional<double> read_conductivity(const DataMembers& members, Physics physics, Diagnostics& diagnostics) {
  const std::string& name = words_of(physics).conductivity.member;
  const Data data(members);
  const Data* const found = data.find(name);
  if (!found) return std::nullopt;
  return MemberReader(diagnostics).number(*found, name, {1e-12, 1e12}).value_or(1);
}

}  // namespace ombre::fea
