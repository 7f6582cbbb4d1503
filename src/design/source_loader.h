// Sources: what lies in files, or needs more than formulas. A node fills in a request, and somebody else reads and
// builds.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/math/polygons.h"
#include "design/node.h"
#include "design/stage.h"
#include "program/field_source.h"

namespace ombre::sources {
class Loading;
}

namespace ombre::design {

// What of a file with several bodies is meant, and which materials these get.
struct MeshUse {
  std::string object;                         // the name of one of the file's objects; empty: all
  Choice inside = "nonzero";                  // or "parity", "generalized"
  Choice materials = "one";                   // or "names", "colours"
  MaterialName material;                      // of all, or of what has none in the file
  std::vector<MaterialForName> material_map;  // before the names in the table of materials
};

// The triangles and lattices of one material.
struct MeshPart {
  std::string material;         // its name in the design; empty: the use's own
  program::SourceField source;  // with the channels "inside" and "distance"
  bool is_exact = true;         // "distance" is the one to the surface everywhere
};

// What a designer should know of a source, once it is made.
struct Remark {
  Severity severity = Severity::warning;
  std::string message;
  Phrase hint;
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

// The solids of one material.
struct CadPart {
  std::string material;  // as for meshes
  PendingSourcePtr source;
  bool is_single = true;  // one solid, not several
};

// An image as a field: channel "value", 0 for black to 1 for white, in pixels from its left lower corner.
struct HeightImage {
  program::SourceField source;
  double columns = 0, rows = 0;         // pixels
  double step_across = 0, step_up = 0;  // the greatest differences between neighbours
};

// Requests. A node fills one in; its members, and the content of its file, decide what `load` gives: null, and
// diagnostics, where something is missing or wrong. Each kind's `load` is written in a file of its own in src/sources.
// A file's path becomes the one where it was found, with the hash of its content.

// A mesh by its materials, each once, in the order in which the file comes to them; with "one" a single part. Open
// meshes are errors unless the rule can do without.
struct MeshRequest {
  using Result = std::vector<MeshPart>;
  FilePath file;
  MeshUse use;
  double deform = 0;  // how many times the displacement moves the points of results
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// A closed surface that a program made, with the names that it gave.
struct MadeSolid {
  std::string part, material;  // empty: none
  std::optional<Rgba> colour;
  std::vector<Vec3> points;                        // mm
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
};

// Made solids in the same way; `object` chooses one of the parts.
struct SolidsRequest {
  using Result = std::vector<MeshPart>;
  std::string name;  // of what made them, for messages
  std::shared_ptr<const std::vector<MadeSolid>> solids;
  MeshUse use;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// An OpenSCAD script in the same way. Its parts, materials and colours are those that the script sets; where solids
// overlap, the first wins.
struct ScadSolids {
  std::vector<MeshPart> parts;
  std::vector<std::string> part_names;  // each once, in the order of the script; "" for solids of no part
};
// The word for a part in a request: solids of no part are the "rest".
inline std::string part_word(const std::string& name) { return name.empty() ? "rest" : name; }
struct ScadRequest {
  using Result = ScadSolids;
  FilePath file;
  std::string script;         // the text, where it is not the file's; the file then says where its paths begin
  ScriptVariables variables;  // take the place of the script's own
  std::string part;           // the word for one part; empty: all of them
  Choice materials = "auto";  // or as in MeshUse; auto: names where the script has some, else colours, else one
  MaterialName material;
  std::vector<MaterialForName> material_map;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// A CAD file in the same way.
struct CadRequest {
  using Result = std::vector<CadPart>;
  FilePath file;
  MeshUse use;              // `inside` does not matter
  bool is_exact = false;    // its surfaces, not triangles
  double tolerance_mm = 0;  // how near triangles must be; 0: a quarter of a voxel
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// What polygons bound, whatever z: channels "inside" and "distance". A warning for a ring that crosses itself.
struct PolygonsRequest {
  using Result = program::FieldSource;
  Polygons polygons;
  bool turns = false;  // about x = 0: edges there are no walls to what is inside
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The straight lines from each point to the next: channels "distance", mm, and "along", the share of the whole length,
// from 0 to 1, up to the nearest place. Of separate points "distance" and "index", the number of the nearest.
struct PathRequest {
  using Result = program::FieldSource;
  std::vector<Vec3> points;
  bool are_separate = false;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

struct ImageRequest {
  using Result = HeightImage;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// An image's pixels, rows from the top, each of red, green, blue and alpha as the file has them: sRGB from 0 to 255.
struct ImagePixels {
  size_t columns = 0, rows = 0;
  std::vector<uint8_t> rgba;
};
struct PixelsRequest {
  using Result = ImagePixels;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The numbers of a CSV file, line by line; words in its first line name the columns. All lines have equally many.
struct TableRequest {
  using Result = std::vector<std::vector<double>>;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The outlines of a text, as of polygons; sizes in mm.
struct TextRequest {
  using Result = program::FieldSource;
  FontName font;  // its content becomes that of the font that was found
  std::string text;
  Choice style = "regular", h_align = "center", v_align = "center", measure = "capitals";
  double height_mm = 10, line_spacing = 1;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The frame of a volume's places; L is left, P posterior, S superior, R right, A anterior.
enum class PatientSpace : uint8_t { unknown, ras, lps, las, left_handed };

// A grid of numbers in the space of its voxels' indices: channels "value" (trilinear), "nearest", "cubic" and its
// derivatives "cubic_x", "cubic_y" and "cubic_z".
struct VolumeGrid {
  program::SourceField source;
  std::optional<Affine> space_from_index;  // in mm, where the file says it
  PatientSpace space = PatientSpace::unknown;
  double otsu_level = 0;  // between its darker and its brighter values, by Otsu's method
  // Encloses the places where a channel may have a value of the interval.
  std::function<Box(int channel, Interval values)> places;
};

// NRRD, NIfTI, MetaImage, VTI, NPY, raw numbers with a description beside them, a file or folder of DICOM, or an image
// or a folder of images (PNG, TIFF, BMP), from the lowest layer up, whose numbers are those of the pixels.
struct VolumeRequest {
  using Result = VolumeGrid;
  FilePath file;
  std::string series = {};   // of several in a folder: its number or UID; empty: there is one
  int channel = -1;          // of several values in each voxel, counted from 0; -1: there is one
  std::string segment = {};  // of a segmentation, the name of one; it decides the channel; empty: none is meant
  int64_t label = -1;        // the segment's number, once it is loaded
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// Coloured voxels in the space of their indices: the channel "nearest" is the number of a voxel's colour in the list,
// counted from 1, and 0 where it is transparent.
struct ColourGrid {
  VolumeGrid grid;
  std::vector<Rgba> colours;
};

// The images of a folder (PNG, TIFF, BMP), in the order of the numbers in their names, from the lowest layer up; or one
// file. In a layer x grows to the right and y upwards.
struct ImageStackRequest {
  using Result = ColourGrid;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// One field of the results of a simulation.
struct ResultNumbers {
  program::SourceField source;  // in the file's space, mm; has the channel "inside" besides
  std::string name, unit;       // of the field, as the file has it
  std::vector<int> channels;    // of its components
};

// A file with a mesh, or points, and fields. Where there is no value the source's channels are NaN.
struct ResultsRequest {
  using Result = ResultNumbers;
  FilePath file;
  FilePath values = {};             // the fields of a mesh in a deck; without a path: none
  std::string field;                // a name or its beginning; empty: there is one
  Choice outside = "none";          // of the mesh; or "nearest", "value"
  std::optional<double> within_mm;  // how far the nearest place may be
  double otherwise = 0;             // the value outside
  Choice between = "weights";       // values between points without a mesh; or "nearest"
  double deform = 0;                // how many times the displacement moves the mesh
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The kinds of sources there are.
using SourceRequest =
    std::variant<MeshRequest*, SolidsRequest*, ScadRequest*, CadRequest*, PolygonsRequest*, PathRequest*, ImageRequest*,
                 PixelsRequest*, TableRequest*, TextRequest*, VolumeRequest*, ImageStackRequest*, ResultsRequest*>;

// Which parts of a solid need support, on which grid.
struct SupportUse {
  double angle_deg = 0;          // from the vertical; what hangs over by no more supports itself
  std::optional<Vec3> pitch_mm;  // else the job's
};

class SourceLoader {
 public:
  virtual ~SourceLoader() = default;
  // What is requested, perhaps shared with others who requested the same; null, and diagnostics, if it cannot be had.
  template <class Request>
  std::shared_ptr<const typename Request::Result> source(Request& request, const Reader& reader) {
    return std::static_pointer_cast<const typename Request::Result>(find(&request, reader));
  }
  // What stands under a solid that has bounds, in a printer that builds it layer by layer: channels "inside" and
  // "distance". It reaches up into the solid by part of a cell. Null, and diagnostics, without bounds.
  virtual StagePtr support(const NodePtr& solid, const SupportUse& use, const Reader& reader) = 0;

 protected:
  // The `Result` of the request that the variant holds.
  virtual std::shared_ptr<const void> find(SourceRequest request, const Reader& reader) = 0;
};

}  // namespace ombre::design
