// Writes 3D/3dmodel.model: materials, colours, objects, and the items to build.
#include "formats/containers/xml_text.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/three_mf_beams_text.h"
#include "formats/packages/three_mf_mesh_text.h"
#include "formats/packages/three_mf_text.h"
#include "formats/slicers/project_filaments.h"
#include "formats/slicers/prusa_project.h"

namespace ombre::formats {
namespace {

constexpr std::string_view model_begin =
    "<model unit=\"millimeter\" xml:lang=\"en-US\""
    " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\""
    " xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\""
    " xmlns:slic3rpe=\"http://schemas.slic3r.org/3mf/2017/06\"";

std::string id_text(uint64_t id) { return xml_attribute("id", std::to_string(id)); }

class ModelText {
 public:
  ModelText(const MeshDocument& document, SlicerFlavour flavour) : document_(document), flavour_(flavour) {
    for (const MeshBody& body : document.bodies)
      if (!body.triangles.empty()) bodies_.push_back(&body);
    materials_id_ = bodies_.size() + 2;
    first_colours_id_ = materials_id_ + 1;
    for (const WrittenBeams& beams : document.beams)
      if (!beams.beams.empty()) beams_.push_back(&beams);
    first_clip_id_ = first_colours_id_ + bodies_.size();
    first_beams_id_ = first_clip_id_ + document.clips.size();
  }

  LazyBytes make() {
    add_begin();
    add_materials();
    for (size_t i = 0; i < bodies_.size(); ++i) add_colours(i);
    if (flavour_ == SlicerFlavour::prusa)
      add_joint_object();
    else
      add_parts();
    bytes_.add("</model>\n");
    return std::move(bytes_);
  }

 private:
  void add_begin() {
    std::string text(xml_declaration);
    text += model_begin;
    if (!beams_.empty()) text += beam_lattice_space;
    text += ">\n";
    text += "<metadata name=\"slic3rpe:Version3mf\">1</metadata>\n";
    if (flavour_ == SlicerFlavour::prusa && has_paint(document_))
      text += "<metadata name=\"slic3rpe:MmPaintingVersion\">1</metadata>\n";
    if (!document_.title.empty()) text += "<metadata name=\"Title\">" + xml_escaped(document_.title) + "</metadata>\n";
    bytes_.add(text + "<metadata name=\"Application\">ombre</metadata>\n<resources>\n");
  }

  void add_materials() {
    if (document_.materials.empty()) return;
    std::string text = "<basematerials" + id_text(materials_id_) + ">\n";
    for (const MeshMaterial& material : document_.materials)
      text += "<base" + xml_attribute("name", material.name) +
              xml_attribute("displaycolor", hex_colour(material.colour)) + "/>\n";
    bytes_.add(text + "</basematerials>\n");
  }

  void add_colours(size_t index) {
    const MeshBody& body = *bodies_[index];
    if (body.vertex_colours.empty()) return;
    bytes_.add("<m:colorgroup" + id_text(first_colours_id_ + index) + ">\n");
    bytes_.add_rows(body.vertex_colours.size(), [&body](std::string& text, size_t vertex) {
      text += "<m:color color=\"" + hex_colour(body.vertex_colours[vertex]) + "\"/>\n";
    });
    bytes_.add("</m:colorgroup>\n");
  }

  // Returns the properties that an object's triangles need, given whether the object states its material.
  TriangleProperties properties_of(size_t index, bool object_has_material) const {
    const MeshBody& body = *bodies_[index];
    const std::string_view paint = flavour_ == SlicerFlavour::prusa ? "slic3rpe:mmu_segmentation" : "";
    if (!body.vertex_colours.empty()) return {first_colours_id_ + index, std::nullopt, paint};
    if (body.material && !object_has_material) return {materials_id_, body.material, paint};
    return {0, std::nullopt, paint};
  }

  // Adds one object whose bodies are ranges of triangles and vertices, as PrusaSlicer expects.
  void add_joint_object() {
    bytes_.add("<object" + id_text(1) + " type=\"model\"" + xml_attribute("name", document_.title) +
               ">\n<mesh>\n<vertices>\n");
    for (const MeshBody* body : bodies_) add_model_vertices(bytes_, *body);
    bytes_.add("</vertices>\n<triangles>\n");
    uint64_t first_vertex = 0;
    for (size_t i = 0; i < bodies_.size(); ++i) {
      add_model_triangles(bytes_, *bodies_[i], first_vertex, properties_of(i, false));
      first_vertex += bodies_[i]->vertices.size();
    }
    bytes_.add("</triangles>\n</mesh>\n</object>\n");
    add_build(1, xml_attribute("transform", placement_on_bed(document_, prusa_bed_mm)));
  }

  void add_parts() {
    std::string components;
    for (size_t i = 0; i < bodies_.size(); ++i) {
      add_part(i);
      components += "<component" + xml_attribute("objectid", std::to_string(i + 1)) + "/>\n";
    }
    for (size_t i = 0; i < document_.clips.size(); ++i) add_clip(i);
    for (size_t i = 0; i < beams_.size(); ++i) {
      add_beams(i);
      components += "<component" + xml_attribute("objectid", std::to_string(first_beams_id_ + i)) + "/>\n";
    }
    const uint64_t assembly = bodies_.size() + 1;
    bytes_.add("<object" + id_text(assembly) + " type=\"model\"" + xml_attribute("name", document_.title) +
               ">\n<components>\n" + components + "</components>\n</object>\n");
    add_build(assembly);
  }

  void add_part(size_t index) {
    const MeshBody& body = *bodies_[index];
    std::string begin = "<object" + id_text(index + 1) + " type=\"model\"" + xml_attribute("name", body.name);
    if (body.material)
      begin +=
          xml_attribute("pid", std::to_string(materials_id_)) + xml_attribute("pindex", std::to_string(*body.material));
    bytes_.add(begin + ">\n");
    add_mesh(bytes_, body, properties_of(index, true));
    bytes_.add("</object>\n");
  }

  // Adds a clipping object, which is not built but only referred to by lattices.
  void add_clip(size_t index) {
    const MeshBody& clip = document_.clips[index];
    bytes_.add("<object" + id_text(first_clip_id_ + index) + " type=\"model\"" + xml_attribute("name", clip.name) +
               ">\n");
    add_mesh(bytes_, clip, {});
    bytes_.add("</object>\n");
  }

  void add_beams(size_t index) {
    const WrittenBeams& beams = *beams_[index];
    const bool is_clipped = beams.clipping != LatticeClipping::none;
    bytes_.add("<object" + id_text(first_beams_id_ + index) + " type=\"model\"" + xml_attribute("name", beams.name) +
               ">\n<mesh>\n<vertices>\n");
    bytes_.add_rows(beams.vertices.size(),
                    [&beams](std::string& text, size_t vertex) { append_model_vertex(text, beams.vertices[vertex]); });
    bytes_.add("</vertices>\n");
    bytes_.add(beam_lattice_text(beams, is_clipped ? std::optional(first_clip_id_ + beams.clip) : std::nullopt,
                                 materials_id_));
    bytes_.add("</mesh>\n</object>\n");
  }

  void add_build(uint64_t object, const std::string& transform = "") {
    bytes_.add("</resources>\n<build>\n<item" + xml_attribute("objectid", std::to_string(object)) + transform +
               "/>\n</build>\n");
  }

  const MeshDocument& document_;
  SlicerFlavour flavour_;
  std::vector<const MeshBody*> bodies_;     // bodies with triangles
  std::vector<const WrittenBeams*> beams_;  // lattices with beams
  uint64_t materials_id_ = 0, first_colours_id_ = 0, first_clip_id_ = 0, first_beams_id_ = 0;
  LazyBytes bytes_;
};

}  // namespace

LazyBytes three_mf_model(const MeshDocument& document, SlicerFlavour flavour) {
  if (is_of_bambu(flavour)) return bambu_model(document, flavour);
  return ModelText(document, flavour).make();
}

}  // namespace ombre::formats
