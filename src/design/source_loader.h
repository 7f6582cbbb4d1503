// How nodes get at what lies in files or needs more than formulas: they ask, somebody else reads and builds.
#pragma once

#include "base/polygons.h"
#include "design/values.h"
#include "program/field_source.h"

namespace ombre::design {

// What of a mesh file is meant, and which materials it gets.
struct MeshUse {
  std::string object;                         // the name of one of the file's objects; empty: all
  Choice inside;                              // "nonzero", "parity" or "generalized"
  Choice materials;                           // "one", "names" or "colours"
  MaterialName material;                      // of all, or of what has none in the file
  std::vector<MaterialForName> material_map;  // before the names in the table of materials
};

// The triangles of one material.
struct MeshPart {
  MaterialName material;
  program::SourceField source;  // with the channels "inside" and "distance"
};

// How a text is set; sizes in mm.
struct TextUse {
  std::string text;
  Choice style = "regular", h_align = "center", v_align = "center", measure = "capitals";
  double height_mm = 10, line_spacing = 1;
};

// An image as a field: channel "value", 0 for black to 1 for white, in pixels from its left lower corner.
struct HeightImage {
  program::SourceField source;          // null: it could not be read
  double columns = 0, rows = 0;         // pixels
  double step_across = 0, step_up = 0;  // the greatest differences between neighbours
};

class SourceLoader {
 public:
  virtual ~SourceLoader() = default;
  // A mesh by its materials, each once, in the order in which the file comes to them; with "one" a single part. `path`
  // is made relative to what was found. Nothing, and diagnostics, when it is missing, wrong or open.
  virtual std::vector<MeshPart> mesh(std::string& path, const MeshUse& use, const Reader& reader) = 0;
  // What polygons bound, whatever z: channels "inside" and "distance". Where it turns about x = 0, edges there are no
  // walls to what is inside. A warning for a ring that crosses itself.
  virtual program::SourceField polygons(Polygons polygons, bool turns, const Reader& reader) = 0;
  // The straight lines between points: channel "distance".
  virtual program::SourceField path(const std::vector<Vec3>& points) = 0;
  // The file's content is noted in `path`.
  virtual HeightImage heights(FilePath& path, const Reader& reader) = 0;
  // The outlines of a text, as of polygons; `font` is told which font was found. Null, and diagnostics, without one.
  virtual program::SourceField text(FontName& font, const TextUse& use, const Reader& reader) = 0;
};

}  // namespace ombre::design
