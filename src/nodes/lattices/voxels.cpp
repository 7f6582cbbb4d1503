// Solids from stacks of coloured images.
#include <algorithm>
#include <map>

#include "base/text/text.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

std::string hex_text(const Rgba& colour) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  const size_t count = colour[3] == 255 ? 3 : 4;
  for (size_t n = 0; n < count; ++n) {
    text += digits[colour[n] / 16];
    text += digits[colour[n] % 16];
  }
  return text;
}

int distance_between(const Rgba& a, const Rgba& b) {
  int sum = 0;
  for (size_t n = 0; n < 4; ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
  return sum;
}

struct Voxels {
  FilePath path;
  Vec3 voxel{1, 1, 1}, min;
  std::vector<MaterialForName> materials;
  Choice match = "exact";
  std::shared_ptr<const ColourGrid> stack;  // read when the node is made
  std::vector<MaterialId> materials_of_colours;

  static Spec<Voxels> spec() {
    return {"voxel",
            "The pixels of a stack of PNG images as voxels. Each has the material of its colour.",
            {{"path", &Voxels::path, "A folder with an image for each layer, from the lowest up, or a single image",
              required()},
             {"voxel", &Voxels::voxel, "Size of a voxel along x, y and z", required(unit::positive_mm)},
             {"min", &Voxels::min, "Corner with the least x, y and z", unit::point},
             {"materials", &Voxels::materials,
              "Pairs of a colour, \"#ff0000\", and its material; they come before the colours of the materials file"},
             {"match", &Voxels::match,
              "exact: a colour without a material is an error; nearest: it gets the material with the nearest colour",
              one_of({"exact", "nearest"})}},
            no_inputs,
            "voxel(\"models/stack\", (0.5, 0.5, 1));"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("images cannot be read here");
    ImageStackRequest request{path};
    stack = reader.loader->source(request, reader);
    if (!stack) return false;
    path = request.file;
    return find_materials(reader);
  }

  Metric metric() const { return Metric::implicit(); }

  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box places = stack->grid.places(channel(), Interval(0.5 - margin, Box::inf));
    if (places.is_empty()) return places;
    const Box all = stack->grid.source->bounds();
    return intersect(image(here_from_index(), intersect(places, all).expanded(margin)), where);
  }

  Field distance(const Point& p) const {
    const Point at = p.mapped(inverse(here_from_index()));
    const Box cells = stack->grid.source->bounds();
    const Vec3 c = cells.center(), h = 0.5 * cells.size();
    const Field from_grid = corner(abs(at.x - c.x) - h.x, abs(at.y - c.y) - h.y, abs(at.z - c.z) - h.z);
    return select(from_grid <= 0, 0.5 - number_at(at), max(from_grid, 0.5));
  }

  Composition composition(const Inputs&, const Point& p, Demand) const {
    const Field number = number_at(p.mapped(inverse(here_from_index())));
    std::map<MaterialId, Field> shares;
    // Transparent voxels, whose composition matters only to blends, count as the first colour.
    for (size_t n = 0; n < materials_of_colours.size(); ++n) {
      const auto colour = static_cast<double>(n + 1);
      const Field is_it = n == 0 ? less(number, p.constant(1.5)) : less(abs(number - colour), p.constant(0.5));
      const auto [it, is_new] = shares.try_emplace(materials_of_colours[n], is_it);
      if (!is_new) it->second = max(it->second, is_it);
    }
    return {{shares.begin(), shares.end()}, {}};
  }

 private:
  int channel() const { return stack->grid.source->channel("nearest"); }
  Field number_at(const Point& at) const {
    return at.builder().source(stack->grid.source, channel(), at.x, at.y, at.z);
  }
  Affine here_from_index() const {
    Affine map = Affine::scaling(voxel);
    map.offset = min + 0.5 * voxel;
    return map;
  }

  // Returns the listed material of a colour, else that of the table, else null.
  const Material* material_of(const Rgba& colour, const Reader& reader) const {
    for (const auto& [name, material] : materials)
      if (to_lower(name) == hex_text(colour)) return material.material;
    for (const Material& material : reader.materials.all())
      if (material.id != void_id && material.colour == colour) return &material;
    return nullptr;
  }

  const Material* nearest_of(const Rgba& colour, const Reader& reader) const {
    const Material* nearest = nullptr;
    for (const Material& material : reader.materials.all()) {
      if (material.id == void_id) continue;
      if (!nearest || distance_between(material.colour, colour) < distance_between(nearest->colour, colour))
        nearest = &material;
    }
    return nearest;
  }

  bool find_materials(const Reader& reader) {
    std::vector<std::string> unknown;
    for (const Rgba& colour : stack->colours) {
      const Material* material = material_of(colour, reader);
      if (!material) {
        material = nearest_of(colour, reader);
        unknown.push_back(hex_text(colour) + (match == "nearest" && material ? " (" + material->name + ")" : ""));
      }
      materials_of_colours.push_back(material ? material->id : void_id);
    }
    return unknown.empty() || report_unknown(unknown, reader);
  }

  bool report_unknown(std::vector<std::string> unknown, const Reader& reader) const {
    constexpr size_t most_named = 8;
    const size_t count = unknown.size();
    unknown.resize(std::min(count, most_named));
    const std::string list = join(unknown, ", ") + (count > most_named ? ", ..." : "");
    const std::string what = "the images of \"" + path.path + "\" have " + std::to_string(count) +
                             (count == 1 ? " colour" : " colours") + " that no material has: " + list;
    if (match == "nearest") {
      reader.diagnostics.warning(reader.where, what, "each gets the material with the nearest colour");
      return true;
    }
    return reader.refuse(what, "write " +
                                   spelled::parameter("materials", "[[\"" + unknown.front() + "\", \"" +
                                                                       reader.materials.first().name + "\"]]") +
                                   ", or " + spelled::parameter("match", "\"nearest\""));
  }

  static constexpr MaterialId void_id = 0;
};

}  // namespace

void add_voxels(Registry& registry) { registry.add<Voxels>("imported"); }

}  // namespace ombre::nodes
