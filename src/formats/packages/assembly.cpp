#include "formats/packages/assembly.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

constexpr size_t most_levels = 32;
// Limits on the totals that repetition of objects creates; a file may exceed them if it lists everything individually.
constexpr uint64_t most_instances = 1'000'000, most_groups = 1'000'000;
constexpr uint64_t most_triangles = 50'000'000, most_vertices = 50'000'000, most_beams = 50'000'000;

struct Amount {
  uint64_t instances = 0, groups = 0, vertices = 0, triangles = 0, beams = 0;
  size_t levels = 0;

  // Returns the amount of an object without its components. A ball counts as a beam.
  static Amount of(const Mesh& mesh) {
    Amount amount{1, mesh.groups.size() + mesh.lattices.size(), mesh.vertices.size(), mesh.triangles.size()};
    for (const PlacedLattice& placed : mesh.lattices)
      amount.beams += placed.lattice->beams.size() + placed.lattice->balls.size();
    return amount;
  }

  // Adds an amount; sums are clamped far above all limits, so that they cannot overflow.
  void add(const Amount& other) {
    constexpr uint64_t beyond = uint64_t{1} << 40;
    instances = std::min(instances + other.instances, beyond);
    groups = std::min(groups + other.groups, beyond);
    vertices = std::min(vertices + other.vertices, beyond);
    triangles = std::min(triangles + other.triangles, beyond);
    beams = std::min(beams + other.beams, beyond);
    levels = std::max(levels, other.levels);
  }
};

class Assembler {
 public:
  Assembler(const Assembly& assembly, const std::string& file, Diagnostics& diagnostics)
      : assembly_(assembly), file_(file), diagnostics_(diagnostics), warnings_(assembly.warnings) {}

  Mesh assemble() {
    const Amount amount = measure_build();
    warnings_.report(file_, diagnostics_);
    check(amount);
    mesh_.vertices.reserve(amount.vertices);
    mesh_.triangles.reserve(amount.triangles);
    const double mm = assembly_.mm_per_unit;
    for (const Placement& item : assembly_.build) {
      const AssemblyObject& object = find(item.object);
      place(object, Affine::scaling({mm, mm, mm}) * item.parent_from_object, object.name);
    }
    mesh_.images = assembly_.images;
    return std::move(mesh_);
  }

 private:
  const AssemblyObject& find(const std::string& key) const {
    const auto found = assembly_.objects.find(key);
    if (found == assembly_.objects.end()) fail(diagnostics_, file_, "there is no object " + key + ", but it is used");
    return found->second;
  }

  // Returns the amount of all objects counted once.
  Amount listed() const {
    Amount amount;
    for (const auto& [key, object] : assembly_.objects) amount.add(Amount::of(object.mesh));
    return amount;
  }

  Amount measure_build() {
    Amount amount;
    for (const Placement& item : assembly_.build) amount.add(measure(item.object, 1));
    return amount;
  }

  void check(const Amount& amount) const {
    const Amount once = listed();
    if (amount.instances > std::max(most_instances, once.instances) ||
        amount.groups > std::max(most_groups, once.groups) ||
        amount.triangles > std::max(most_triangles, once.triangles) ||
        amount.vertices > std::max(most_vertices, once.vertices) || amount.beams > std::max(most_beams, once.beams))
      fail(diagnostics_, file_,
           "its objects are repeated too often: to " + format_count(amount.triangles) + " triangles and " +
               format_count(amount.beams) + " beams in " + format_count(amount.instances) + " places; at most " +
               format_count(most_triangles) + " of either in " + format_count(most_instances) + " are made");
    if (amount.triangles == 0 && amount.beams == 0)
      fail(diagnostics_, file_, "nothing that is built has triangles", "save it with at least one mesh");
    if (amount.triangles > UINT32_MAX || amount.vertices > UINT32_MAX)
      fail(diagnostics_, file_, "there are too many triangles or vertices: more than 4,294,967,295");
  }

  // Returns the total amount of an object; each is visited once.
  Amount measure(const std::string& key, size_t level) {
    if (const auto known = amounts_.find(key); known != amounts_.end()) {
      if (known->second.instances == 0) fail(diagnostics_, file_, "the object " + key + " consists of itself");
      return known->second;
    }
    if (level > most_levels) fail_deep();
    const AssemblyObject& object = find(key);
    amounts_[key] = {};  // marks an object whose components are being measured
    if (!object.no_solid.empty())
      warnings_.add("an object " + object.no_solid + " is no part of the solid and is left out",
                    "objects " + object.no_solid + " are no part of the solid and are left out");
    Amount amount = Amount::of(object.mesh);
    for (const Placement& component : object.components) amount.add(measure(component.object, level + 1));
    // An object that was measured before may be nested more deeply here.
    if (++amount.levels > most_levels) fail_deep();
    return amounts_[key] = amount;
  }

  [[noreturn]] void fail_deep() const {
    fail(diagnostics_, file_, "objects within objects go deeper than " + std::to_string(most_levels) + " levels");
  }

  void place(const AssemblyObject& object, const Affine& mm_from_object, const std::string& whole) {
    if (!object.mesh.triangles.empty()) append(object, mm_from_object, whole);
    for (const PlacedLattice& placed : object.mesh.lattices) append(placed, object, mm_from_object, whole);
    for (const Placement& component : object.components)
      place(find(component.object), mm_from_object * component.parent_from_object, whole);
  }

  void append(const AssemblyObject& object, const Affine& mm_from_object, const std::string& whole) {
    const auto first_vertex = static_cast<uint32_t>(mesh_.vertices.size());
    const auto first_triangle = static_cast<uint32_t>(mesh_.triangles.size());
    for (const Vec3& p : object.mesh.vertices) mesh_.vertices.push_back(usable(mm_from_object(p)));
    const bool is_mirrored = determinant(mm_from_object) < 0;
    for (const auto& [a, b, c] : object.mesh.triangles)
      mesh_.triangles.push_back(
          {first_vertex + a, first_vertex + (is_mirrored ? c : b), first_vertex + (is_mirrored ? b : c)});
    for (MeshGroup group : object.mesh.groups) {
      group.first_triangle += first_triangle;
      mesh_.groups.push_back(named(std::move(group), object, whole));
    }
    append_shadings(object.mesh, is_mirrored);
  }

  // Adds the shadings of an object's triangles, which are those of the last groups, if it or one before it has some.
  void append_shadings(const Mesh& mesh, bool is_mirrored) {
    if (mesh.shadings.empty() && mesh_.shadings.empty()) return;
    const size_t before = mesh_.triangles.size() - mesh.triangles.size();
    const auto fill = [this](size_t end) {
      for (const MeshGroup& group : mesh_.groups)
        for (size_t n = mesh_.shadings.size(); n < std::min<size_t>(end, group.first_triangle + group.triangle_count);
             ++n)
          mesh_.shadings.push_back(shading_of(group));
    };
    fill(mesh.shadings.empty() ? mesh_.triangles.size() : before);
    for (TriangleShading shading : mesh.shadings) {
      if (is_mirrored) {
        std::swap(shading.colours[1], shading.colours[2]);
        std::swap(shading.places[1], shading.places[2]);
      }
      mesh_.shadings.push_back(shading);
    }
  }

  static MeshGroup named(MeshGroup group, const AssemblyObject& object, const std::string& whole) {
    if (group.name.empty()) group.name = object.name;
    if (group.name != whole) group.object = whole;
    return group;
  }

  void append(const PlacedLattice& placed, const AssemblyObject& object, const Affine& mm_from_object,
              const std::string& whole) {
    const Affine mm_from_lattice = mm_from_object * placed.mm_from_lattice;
    for (const Vec3& p : placed.lattice->vertices) usable(mm_from_lattice(p));
    mesh_.lattices.push_back({named(placed.group, object, whole), placed.lattice, mm_from_lattice});
  }

  Vec3 usable(Vec3 p) const {
    const double greatest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (is_finite(p) && greatest <= greatest_coordinate) return p + Vec3{0, 0, 0};  // maps -0 to 0
    fail(diagnostics_, file_,
         "a corner comes to lie too far away: (" + format_number(p.x) + ", " + format_number(p.y) + ", " +
             format_number(p.z) + ") mm",
         "coordinates may go up to 1e15");
  }

  const Assembly& assembly_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  CountedWarnings warnings_;
  std::map<std::string, Amount> amounts_;  // 0 instances: being measured
  Mesh mesh_;
};

}  // namespace

TriangleShading shading_of(const MeshGroup& group) {
  TriangleShading shading;
  if (group.colour) shading.colours.fill(shares_of(*group.colour));
  return shading;
}

std::optional<double> mm_per_unit(std::string_view unit) {
  struct Unit {
    std::string_view name;
    double mm;
  };
  constexpr Unit units[]{{"micron", 0.001}, {"micrometer", 0.001}, {"millimeter", 1}, {"centimeter", 10},
                         {"meter", 1000},   {"inch", 25.4},        {"foot", 304.8},   {"feet", 304.8}};
  for (const Unit& known : units)
    if (known.name == unit) return known.mm;
  return std::nullopt;
}

Mesh assemble(const Assembly& assembly, const std::string& file, Diagnostics& diagnostics) {
  return Assembler(assembly, file, diagnostics).assemble();
}

}  // namespace ombre::formats
