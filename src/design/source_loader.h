// Requests for data from files, or for fields that need more than formulas. A node fills in a request; code outside the
// design reads and builds the source.
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
namespace ombre::solids {
struct Piece;
}

namespace ombre::design {

// The selection of bodies of a mesh file, and the materials that they get.
struct MeshUse {
  std::string object;                         // name of one of the file's objects; empty for all
  Choice inside = "nonzero";                  // rule for the inside: "nonzero", "parity" or "generalized"
  Choice materials = "one";                   // source of materials: "one", "names" or "colours"
  MaterialName material;                      // material of all bodies, or of those without one in the file
  std::vector<MaterialForName> material_map;  // looked up before the table of materials
};

// The triangles and lattices of one material.
struct MeshPart {
  std::string material;         // name in the design; empty for the material of the MeshUse
  program::SourceField source;  // has the channels "inside" and "distance"
  bool is_exact = true;         // true if "distance" is the exact distance to the surface everywhere
};

// A message for the designer about a source that was made.
struct Remark {
  Severity severity = Severity::warning;
  std::string message;
  Phrase hint;
};

// A source that is made once a job's resolution is known. Thread-safe.
class PendingSource {
 public:
  virtual ~PendingSource() = default;
  virtual Hash content() const = 0;  // hash of everything from which it is made
  virtual Box bounds() const = 0;    // nothing is inside beyond this box
  // Makes the source for a job of this scale, in the source's own space; without a scale, its size determines the
  // resolution. It has the channels "inside" and "distance". The same scale gives the same source. Throws Error.
  virtual program::SourceField make(const std::optional<JobScale>& scale) const = 0;
  // Returns messages about that source, which is made if necessary.
  virtual std::vector<Remark> remarks(const std::optional<JobScale>& /*scale*/) const { return {}; }
};
using PendingSourcePtr = std::shared_ptr<const PendingSource>;

// The solids of one material.
struct CadPart {
  std::string material;  // name of the material, as in MeshPart
  PendingSourcePtr source;
  bool is_single = true;  // true if it is a single solid
};

// An image as a field with the channel "value", from 0 for black to 1 for white, in pixels from its lower left corner.
struct HeightImage {
  program::SourceField source;
  double columns = 0, rows = 0;         // size in pixels
  double step_across = 0, step_up = 0;  // greatest differences between neighbours
};

// Requests. A node fills in a request. Its members and the content of its file determine the result of `load`, which is
// null, with diagnostics added, if something is missing or wrong. Each kind's `load` is in its own file in src/sources.
// It sets a FilePath to the path where the file was found, with the hash of its content.

// A mesh, divided by materials in the order of their occurrence in the file; a single part if materials is "one". Open
// meshes are errors unless the rule of `inside` accepts them.
struct MeshRequest {
  using Result = std::vector<MeshPart>;
  FilePath file;
  MeshUse use;
  double deform = 0;  // factor of the displacement that moves the points of simulation results
  int step = 0;       // number of the step of simulation results, from 1; 0 for the last
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// A closed surface that a program made, with the names that it gave.
struct MadeSolid {
  std::string part, material;  // empty if there is none
  std::optional<Rgba> colour;
  std::vector<Vec3> points;                        // corners in mm
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// Solids that a program made, divided by materials as for a mesh. `object` selects one of the parts.
struct SolidsRequest {
  using Result = std::vector<MeshPart>;
  std::string name;  // name of their origin, for messages
  std::shared_ptr<const std::vector<MadeSolid>> solids;
  MeshUse use;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// All solids of a script that have the same name: that of their part, else of their material or colour, else "".
struct ScadBody {
  std::string name;
  program::SourceField source;  // has the channels of MeshPart; null if there is no other body
};
// The solids of an OpenSCAD script, divided by materials. The script sets their parts, materials and colours. Where
// solids overlap, the first wins.
struct ScadSolids {
  std::vector<MeshPart> parts;
  std::vector<std::string> part_names;  // each once, in the order of the script; "" for solids outside parts
  std::vector<ScadBody> bodies = {};    // divided by names, in the order of the script
  // The exact solids with, for each, its body's name and its material, which is as in MeshPart.
  std::shared_ptr<const std::vector<solids::Piece>> pieces = {};
  std::vector<std::string> piece_names = {}, piece_materials = {};
};
// Returns the word for a part in a request; solids outside parts are the "rest".
inline std::string part_word(const std::string& name) { return name.empty() ? "rest" : name; }
struct ScadRequest {
  using Result = ScadSolids;
  FilePath file;
  std::string script;  // the script's text if it is not the file's; the file then gives the base of relative paths
  ScriptVariables variables;  // values that override the script's variables
  std::string part;           // word of one part; empty for all
  // Source of materials: as in MeshUse, or "auto": names if the script has some, else colours, else one.
  Choice materials = "auto";
  MaterialName material;
  std::vector<MaterialForName> material_map;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The solids of a CAD file, divided by materials as for a mesh.
struct CadRequest {
  using Result = std::vector<CadPart>;
  FilePath file;
  MeshUse use;              // `inside` is ignored
  bool is_exact = false;    // uses the file's surfaces instead of triangles
  double tolerance_mm = 0;  // greatest distance of triangles from the surface; 0 for a quarter of a voxel
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// A region that polygons bound, independent of z, with the channels "inside" and "distance". A ring that crosses itself
// gives a warning.
struct PolygonsRequest {
  using Result = program::FieldSource;
  Polygons polygons;
  bool turns = false;  // the region is revolved about x = 0, where edges are not walls
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// Distances to what points give.
// - path: the polyline through them, with the channels "distance" in mm and "along", the share (0 to 1) of the whole
//   length up to the nearest position.
// - separate: the points, with the channels "distance" and "index", the number of the nearest point.
// - pairs: a segment from each even point to the next one, with the channel "distance". With a `fillet` R it is
//   R - sqrt(sum of (R - d)^2) over all segments whose distances d are less than R, if there are any.
// - triples: a triangle of each three points, with the channel "distance".
// - cells: the Voronoi cells of at least two points, with the channel "distance" from the nearest wall between cells.
enum class PathKind : uint8_t { path, separate, pairs, triples, cells };
struct PathRequest {
  using Result = program::FieldSource;
  std::vector<Vec3> points;
  PathKind kind = PathKind::path;
  double fillet = 0;  // mm; of pairs alone
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

struct ImageRequest {
  using Result = HeightImage;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The pixels of an image, row by row from the top, as red, green, blue and alpha in sRGB from 0 to 255.
struct ImagePixels {
  size_t columns = 0, rows = 0;
  std::vector<uint8_t> rgba;
};
struct PixelsRequest {
  using Result = ImagePixels;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The numbers of a CSV file, line by line. Words in its first line are names of columns. All lines must have the same
// number of values.
struct TableRequest {
  using Result = std::vector<std::vector<double>>;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// Shares of a machine's inks for colours in sRGB, and what comes of them, as ink::InkTable describes them.
struct InkShares {
  size_t inks = 0;
  std::string space;                        // colour space of the profile: "CMYK"
  std::vector<std::vector<double>> values;  // of each ink, then the visible difference
  double most_ink = 0, mean_error = 0, worst_error = 0;
};
// An ICC output profile, used with a rendering intent.
struct InkRequest {
  using Result = InkShares;
  FilePath profile;
  Choice intent = "relative";
  bool black_point = true;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The colours of a mesh's surface, with the channels "red", "green", "blue" and "alpha" from 0 to 1 in sRGB: of its
// vertices, or of an image at its texture coordinates.
struct SurfaceColoursRequest {
  using Result = program::FieldSource;
  FilePath file, image;  // an empty path for colours of the vertices
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The lengths of shortest ways along the surface of a mesh, with the channel "distance" in mm: to the point of the
// surface that is nearest to a place, from the nearest of those that are nearest to `from`.
struct GeodesicRequest {
  using Result = program::FieldSource;
  FilePath file;
  std::vector<Vec3> from;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The outlines of a text as polygons; sizes in mm.
struct TextRequest {
  using Result = program::FieldSource;
  FontName font;  // `load` sets its content to that of the font that was found
  std::string text;
  Choice style = "regular", h_align = "center", v_align = "center", measure = "capitals";
  double height_mm = 10, line_spacing = 1;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The coordinate system of a medical volume. L is left, P posterior, S superior, R right, A anterior.
enum class PatientSpace : uint8_t { unknown, ras, lps, las, left_handed };

// A grid of numbers in the space of voxel indices, with the channels "value" (trilinear), "nearest", "cubic" and its
// derivatives "cubic_x", "cubic_y" and "cubic_z".
struct VolumeGrid {
  program::SourceField source;
  std::optional<Affine> space_from_index;  // in mm, if the file gives it
  PatientSpace space = PatientSpace::unknown;
  double otsu_level = 0;               // threshold between dark and bright values by Otsu's method
  std::optional<double> padding = {};  // the number in voxels that the scan marks as padding, if there are any
  // Returns a box around the positions where a channel may have a value in the interval.
  std::function<Box(int channel, Interval values)> places;
};

// A volume: NRRD, NIfTI, MetaImage, VTI, NPY, raw numbers with a description in a separate file, a file or folder
// of DICOM, or an image or a folder of images (PNG, TIFF, BMP) from the lowest layer up, whose numbers are pixel
// values.
struct VolumeRequest {
  using Result = VolumeGrid;
  FilePath file;
  std::string series = {};   // number or UID of one of several series in a folder; empty if there is only one
  int channel = -1;          // number, from 0, of one of several values per voxel; -1 if there is only one
  std::string segment = {};  // name of a segment of a segmentation, which determines the channel; empty for none
  int64_t label = -1;        // number of the wanted label, if there is one; `load` sets that of a segment
  int phase = 0;             // number, from 1, of one of several volumes at the same place; 0 if there is only one
  bool are_labels = false;   // true where images with a palette give indices
  bool is_regular = false;   // true where slices at uneven distances are resampled
  std::optional<double> nan = {};      // the number in place of NaN, which is an error without it
  std::optional<double> outside = {};  // the number of voxels that a scan marks as padding; else `is_outside_high`
  bool is_outside_high = false;        // padding gets the greatest number of the scan, in place of the least
  std::optional<double> level = {};    // of a solid: the number of padding lies beyond it in any case
  bool has_space = false;              // true where the design chooses the coordinate system
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// Coloured voxels in the space of their indices. The channel "nearest" is the number of a voxel's colour in the list,
// counted from 1, or 0 for transparent voxels.
struct ColourGrid {
  VolumeGrid grid;
  std::vector<Rgba> colours;
};

// The images of a folder (PNG, TIFF, BMP) from the lowest layer up, sorted by the numbers in their names; or a single
// file. In a layer x grows to the right and y upwards.
struct ImageStackRequest {
  using Result = ColourGrid;
  FilePath file;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// One field of simulation results.
struct ResultNumbers {
  program::SourceField source;  // values in the file's space, in mm; also has the channel "inside"
  std::string name, unit;       // name and unit of the field in the file
  std::vector<int> channels;    // channels of its components
};

// A file with a mesh, or points, and fields. Where there is no value, the source's channels are NaN.
struct ResultsRequest {
  using Result = ResultNumbers;
  FilePath file;
  FilePath values = {};             // file with the fields for a mesh in a deck; an empty path if there is none
  std::string field;                // a name or its beginning; empty if there is only one field
  Choice outside = "none";          // value outside the mesh; or "nearest", "value"
  std::optional<double> within_mm;  // greatest distance to the nearest position
  double otherwise = 0;             // value outside, for "value"
  Choice between = "weights";       // interpolation between points without a mesh; or "nearest"
  double deform = 0;                // factor of the displacement that moves the mesh
  int step = 0;                     // number of the step, from 1; 0 for the last
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// The space above a part of a surface. The source has the channels "u" and "v" in mm from 0 on, "height", their
// derivatives "u_x" to "height_z" by position, and "outside", g of that space.
struct SurfaceSpace {
  program::SourceField source;
  Vec2 lengths;             // greatest u and v
  Interval heights;         // of the lower and the upper side; 0 and 1 between two surfaces
  double thickness_mm = 0;  // mean way from the lower side to the upper one
  // Least and greatest volume per unit of u, v and height, and stretch of lengths along the surface; greatest ratio of
  // the stretches at a place.
  Interval volumes, stretches;
  double aspect = 1;
  std::vector<std::array<Vec2, 2>> border;  // lines around the part in u and v, mm
};

// A part of the surface of a mesh or CAD file. Conditions are combined; without any, all of the surface is taken. A
// single face of a CAD file keeps its own u and v; several are joined and laid out as a mesh is.
struct SurfaceChoice {
  FilePath file;
  std::optional<Vec3> at;      // triangles linked to the one nearest to this point ...
  double angle_deg = 180;      // ... over edges that bend by at most this angle
  std::optional<Box> box;      // triangles whose centres lie in it
  std::optional<Vec3> normal;  // triangles that face this direction ...
  double within_deg = 60;      // ... up to this angle
  std::string kind = {};       // of CAD files: the kind of a face, one of cad::face_kinds; empty for any
  Interval area_mm2 = Interval::everything();  // of CAD files: the area of a face
  bool is_rectangle = false;  // of a single face of a CAD file: all between its least and greatest u and v

  bool is_whole() const {
    return !at && !box && !normal && kind.empty() && area_mm2.lo <= 0 && area_mm2.hi == Interval::everything().hi;
  }
};

// Words for how places of two surfaces are joined: along the normals, or at equal shares of u and v. These run along
// the other surface's u and v, or along its v and u, or against them; "nearest" stands for those with the shortest
// ways.
inline constexpr std::array<std::string_view, 10> pairings{"normal",    "nearest",      "uv", "uv_flip_u",
                                                           "uv_flip_v", "uv_flip_both", "vu", "vu_flip_u",
                                                           "vu_flip_v", "vu_flip_both"};

// How parts of surfaces are laid out in a plane.
struct SurfaceLayout {
  Choice method = "lscm";      // "lscm", "arap" or "authalic"
  Vec3 toward{1, 0, 0};        // direction of u, as far as possible
  double tolerance_mm = 0.05;  // greatest distance of triangles from a CAD file's faces, and of a space's upper side
};

struct SurfaceRequest : SurfaceLayout {
  using Result = SurfaceSpace;
  SurfaceChoice part;
  SurfaceChoice to = {};      // another surface, up to which the space reaches; an empty path if there is none
  Choice pairing = "normal";  // one of `pairings`
  double standoff_mm = 0, height_mm = 5;  // without another surface: the space's distance from it, and its height
  bool is_inward = false;                 // the space lies on the inner side
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// Coordinates on a part of a surface: of its point that is nearest to a place. The source has the channels "u" and "v"
// in mm from 0 on, and "distance" in mm, positive on the outer side. "x", "y" and "z" are the nearest point, "normal_x"
// to "normal_z" the smooth normal there, and "border" is its distance from the border in mm.
struct SurfacePlaces {
  program::SourceField source;
  Vec2 lengths;        // greatest u and v
  Interval stretches;  // of lengths along the surface: mm there for a mm of u and v
};
struct SurfacePlacesRequest : SurfaceLayout {
  using Result = SurfacePlaces;
  SurfaceChoice part;
  std::shared_ptr<const Result> load(sources::Loading& loading);
};

// All kinds of requests.
using SourceRequest =
    std::variant<MeshRequest*, SolidsRequest*, ScadRequest*, CadRequest*, PolygonsRequest*, PathRequest*, ImageRequest*,
                 PixelsRequest*, TableRequest*, InkRequest*, SurfaceColoursRequest*, GeodesicRequest*, TextRequest*,
                 VolumeRequest*, ImageStackRequest*, ResultsRequest*, SurfaceRequest*, SurfacePlacesRequest*>;

// The selection of surfaces that need support, and the grid on which supports are computed.
struct SupportUse {
  double angle_deg = 0;          // greatest angle from the vertical at which surfaces support themselves
  std::optional<Vec3> pitch_mm;  // the job's if not set
};

class SourceLoader {
 public:
  virtual ~SourceLoader() = default;
  // Returns the requested data, which may be shared with equal requests. Returns null and adds diagnostics if it is not
  // available.
  template <class Request>
  std::shared_ptr<const typename Request::Result> source(Request& request, const Reader& reader) {
    return std::static_pointer_cast<const typename Request::Result>(find(&request, reader));
  }
  // Returns a stage that computes supports below a solid, for a printer that builds layer by layer. It has the channels
  // "inside" and "distance", and extends into the solid by a fraction of a cell. Returns null and adds diagnostics if
  // the solid is unbounded.
  virtual StagePtr support(const NodePtr& solid, const SupportUse& use, const Reader& reader) = 0;

 protected:
  // Returns the `Result` of the request that the variant holds.
  virtual std::shared_ptr<const void> find(SourceRequest request, const Reader& reader) = 0;
};

}  // namespace ombre::design
