#include "jobs/mesh/beam_document.h"

#include <algorithm>

namespace ombre::compile {
namespace {

// Returns the document's number of a material of the design.
uint32_t material_number(const design::Material& material, const MeshedDesign& made, formats::MeshDocument& document) {
  const auto is_of = [&](const RegionBody& body) { return body.region.material == material.id; };
  const auto body = std::ranges::find_if(made.bodies, is_of);
  if (body != made.bodies.end()) return static_cast<uint32_t>(body - made.bodies.begin());
  for (size_t n = made.bodies.size(); n < document.materials.size(); ++n)
    if (document.materials[n].name == material.name) return static_cast<uint32_t>(n);
  document.materials.push_back({material.name, material.colour});
  return static_cast<uint32_t>(document.materials.size() - 1);
}

std::string numbered(const std::string& name, size_t index, size_t count) {
  return count == 1 ? name : name + ' ' + std::to_string(index + 1);
}

}  // namespace

void add_beams(MeshedDesign& made, const design::MaterialTable& materials, formats::MeshDocument& document) {
  for (size_t n = 0; n < made.clips.size(); ++n)
    document.clips.push_back({numbered("clip", n, made.clips.size()), std::move(made.clips[n].vertices),
                              std::move(made.clips[n].triangles)});
  for (size_t n = 0; n < made.beams.size(); ++n) {
    BeamBody& body = made.beams[n];
    formats::WrittenBeams written;
    written.name = numbered("beams", n, made.beams.size());
    for (const MaterialId id : body.materials)
      written.materials.push_back(material_number(materials.all()[id], made, document));
    if (body.materials.empty()) {
      written.materials.assign(body.beams.size(), static_cast<uint32_t>(document.materials.size()));
      document.materials.push_back({written.name, body.colour});
    }
    written.vertices = std::move(body.vertices);
    written.beams = std::move(body.beams);
    written.clipping = body.clip ? body.clipping : formats::LatticeClipping::none;
    written.clip = static_cast<uint32_t>(body.clip.value_or(0));
    document.beams.push_back(std::move(written));
  }
}

}  // namespace ombre::compile
