// How nodes get at what lies in files or needs more than formulas: they ask, somebody else reads and builds.
#pragma once

#include "base/polygons.h"
#include "design/node.h"
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

// The triangles and lattices of one material.
struct MeshPart {
  MaterialName material;
  program::SourceField source;  // with the channels "inside" and "distance"
  bool is_exact = true;         // "distance" is the one to the surface everywhere
};

// What a designer should know of a source, once it is made.
struct Remark {
  Severity severity = Severity::warning;
  std::string message, hint;
};

// A source that is made when a job knows how finely. Thread-safe.
class PendingSource {
 public:
  virtual ~PendingSource() = default;
  virtual Hash content() const = 0;  // of what it is made from
  virtual Box bounds() const = 0;    // outside of it, nothing is inside
  // For jobs of this scale, in the source's own space; without one, as finely as its size suggests. With the channels
  // "inside" and "distance"; the same source for the same scale. Throws Error.
  virtual program::SourceField make(const std::optional<JobScale>& scale) const = 0;
  // What is to be said of that source. It is made if need be.
  virtual std::vector<Remark> remarks(const std::optional<JobScale>& /*scale*/) const { return {}; }
};
using PendingSourcePtr = std::shared_ptr<const PendingSource>;

// What of a CAD file is meant, and how near to it the solid must be.
struct CadUse {
  MeshUse parts;            // `inside` does not matter
  bool is_exact = false;    // its surfaces, not triangles
  double tolerance_mm = 0;  // of triangles; 0: a quarter of a voxel
};

// The solids of one material.
struct CadPart {
  MaterialName material;
  PendingSourcePtr source;
  bool is_single = true;  // one solid, not several
};

// Which parts of a solid need support, on which grid.
struct SupportUse {
  double angle_deg = 0;          // from the vertical; what hangs over by no more supports itself
  std::optional<Vec3> pitch_mm;  // else the job's
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
  // A CAD file in the same way.
  virtual std::vector<CadPart> cad(std::string& path, const CadUse& use, const Reader& reader) = 0;
  // What stands under a solid that has bounds, in a printer that builds it layer by layer. It reaches up into the solid
  // by part of a cell.
  virtual PendingSourcePtr support(const NodePtr& solid, const SupportUse& use, const Reader& reader) = 0;
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
