#include "jobs/scad/scad_job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "export/mesh_file.h"
#include "export/output_file.h"
#include "formats/drawings/plane_writers.h"
#include "formats/images/uncoloured.h"
#include "lang/openscad/body_names.h"
#include "lang/openscad/colours.h"
#include "solids/booleans.h"
#include "solids/colour_bytes.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;
using formats::MeshBody;
using formats::MeshDocument;
using solids::Piece;
using solids::Pieces;
using solids::Solid;

constexpr std::string_view part_place = "{part}";

std::string name_of(const Piece& piece) {
  const solids::Attributes& attributes = piece.attributes;
  if (!attributes.part.empty()) return "part \"" + attributes.part + '"';
  if (!attributes.material.empty()) return "a solid of \"" + attributes.material + '"';
  if (!attributes.colour) return "a solid without a name";
  return "a solid in " + lang::openscad::colour_name(solids::bytes_of(*attributes.colour));
}

// Returns a point of an edge that triangles do not pass equally often in both directions: the surface is open there.
std::optional<Vec3> open_place(const solids::TriangleMesh& mesh) {
  using Point = std::array<double, 3>;
  std::map<Point, uint32_t> known;
  std::vector<uint32_t> number;
  for (const Vec3& p : mesh.points)
    number.push_back(known.try_emplace(Point{p.x, p.y, p.z}, static_cast<uint32_t>(known.size())).first->second);
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const solids::Triangle& t : mesh.triangles)
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t a = number[t[n]], b = number[t[(n + 1) % 3]];
      if (a != b) edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, balance] : edges)
    if (balance != 0)
      for (size_t n = 0; n < number.size(); ++n)
        if (number[n] == edge.first) return mesh.points[n];
  return std::nullopt;
}

bool check_closed(const Piece& piece, const std::string& path, Diagnostics& messages) {
  if (piece.solid()->flaw() != solids::Flaw::none) return true;  // a warning was given
  const auto place = open_place(piece.solid()->mesh());
  if (!place) return true;
  messages.error({}, path + " is not written: the surface of " + name_of(piece) + " is open near (" +
                         std::to_string(place->x) + ", " + std::to_string(place->y) + ", " + std::to_string(place->z) +
                         ')');
  return false;
}

// Returns a part's name without characters that file names cannot have.
std::string file_word(const std::string& part) {
  if (part.empty()) return "rest";
  std::string word = part;
  for (char& c : word)
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ') c = '_';
  if (word == "." || word == "..") word = "_";
  return word;
}

std::vector<SolidsFile> files_of(const Pieces& pieces, const SolidsExport& to) {
  const size_t place = to.path.find(part_place);
  if (place == std::string::npos) return {{to, pieces}};
  std::vector<SolidsFile> files;
  for (const Piece& piece : pieces) {
    std::string path = to.path;
    path.replace(place, part_place.size(), file_word(piece.attributes.part));
    auto file = std::ranges::find_if(files, [&](const SolidsFile& f) { return f.to.path == path; });
    if (file == files.end()) file = files.insert(file, SolidsFile{SolidsExport{path, to.title, to.flavour}, {}});
    file->pieces.push_back(piece);
  }
  return files;
}

std::optional<std::string> drawing_of(const Pieces& pieces, const std::string& title, const std::string& ending) {
  if (ending != ".svg" && ending != ".dxf") return std::nullopt;
  std::vector<formats::DrawnRegion> regions;
  for (const Piece& piece : pieces) {
    const auto& colour = piece.attributes.colour;
    regions.push_back({piece.attributes.part, colour ? std::optional(solids::bytes_of(*colour)) : std::nullopt,
                       piece.region()->rings});
  }
  return ending == ".svg" ? formats::drawing_svg(title, regions) : formats::drawing_dxf(regions);
}

// True if the format tells solids apart, by bodies or colours.
bool holds_several(const std::string& path) {
  const formats::MeshFormat* const format = formats::find_mesh_format(path);
  return !format || format->holds_bodies || format->holds_colours;
}

Pieces united(const Pieces& pieces, const solids::EvaluateOptions& options) {
  if (pieces.size() < 2) return pieces;
  std::vector<Solid> solids;
  for (const Piece& piece : pieces)
    if (piece.solid()) solids.push_back(*piece.solid());
  return {{{}, solids::unite(std::move(solids), {options.threads, options.stop})}};
}

bool check_format(const Pieces& pieces, const std::string& path, Diagnostics& messages) {
  const std::string ending = fs::path(path).extension().string();
  const bool is_drawing = ending == ".svg" || ending == ".dxf";
  if (!is_drawing && !formats::find_mesh_format(path)) {
    messages.error({}, path + " has no ending of a format",
                   "solids: " + join(formats::written_mesh_endings(), ", ") + "; regions of the plane: .svg, .dxf");
    return false;
  }
  if (pieces.empty()) {
    messages.error({}, path + " is not written: the design is empty");
    return false;
  }
  const int dimension = is_drawing ? 2 : 3;
  for (const Piece& piece : pieces)
    if (piece.dimension() != dimension) {
      messages.error({}, path + " is not written: the design is " + (is_drawing ? "solid" : "flat"),
                     is_drawing
                         ? "write one of " + join(formats::written_mesh_endings(), ", ") + ", or use projection()"
                         : "write .svg or .dxf, or use linear_extrude()");
      return false;
    }
  return true;
}

}  // namespace

Pieces without_overlaps(const Pieces& pieces, const solids::EvaluateOptions& options) {
  const solids::Work work{options.threads, options.stop};
  Pieces result;
  std::vector<Solid> before;
  for (const Piece& piece : pieces) {
    Piece own = piece;
    if (piece.solid()) {
      const Solid rest = solids::subtract(*piece.solid(), before, work);
      before.push_back(*piece.solid());
      if (rest.is_empty()) continue;
      own.shape = rest;
    }
    result.push_back(std::move(own));
  }
  return result;
}

void warn_of_overlaps(const Pieces& pieces, const SourceRange& where, const solids::EvaluateOptions& options,
                      Diagnostics& messages) {
  const solids::Work work{options.threads, options.stop};
  for (size_t n = 1; n < pieces.size(); ++n)
    for (size_t other = 0; other < n; ++other) {
      if (!pieces[n].solid() || !pieces[other].solid()) continue;
      const Solid common = solids::intersect({*pieces[other].solid(), *pieces[n].solid()}, work);
      if (common.is_empty()) continue;
      messages.warning(where, name_of(pieces[other]) + " and " + name_of(pieces[n]) + " overlap",
                       "subtract one from the other, or use " + spelled::option("--no-overlap") + ": the first wins");
    }
}

MeshDocument document_of(const Pieces& pieces, const std::string& title) {
  MeshDocument document{title, {}, {}};
  for (const Piece& piece : pieces) {
    if (!piece.solid()) continue;
    const solids::TriangleMesh& mesh = piece.solid()->mesh();
    const auto& [material, part, colour] = piece.attributes;
    MeshBody body{lang::openscad::body_name(piece.attributes), mesh.points, mesh.triangles};
    if (!material.empty() || colour) {
      const formats::Rgba bytes = colour ? solids::bytes_of(*colour) : formats::uncoloured;
      auto& list = document.materials;
      auto same = std::find_if(list.begin(), list.end(), [&, name = material](const formats::MeshMaterial& m) {
        return m.name == name && m.colour == bytes;
      });
      if (same == list.end()) same = list.insert(same, {material, bytes});
      body.material = static_cast<uint32_t>(same - list.begin());
    }
    document.bodies.push_back(std::move(body));
  }
  return document;
}

std::vector<SolidsFile> solids_files(const Pieces& pieces, const SolidsExport& to,
                                     const solids::EvaluateOptions& options, Diagnostics& messages) {
  if (!check_format(pieces, to.path, messages)) return {};
  for (const Piece& piece : pieces)
    if (piece.solid() && !check_closed(piece, to.path, messages)) return {};
  std::vector<SolidsFile> files = files_of(pieces, to);
  for (SolidsFile& file : files)
    if (!holds_several(file.to.path)) file.pieces = united(file.pieces, options);
  return files;
}

void write_solids_file(const SolidsFile& file) {
  const std::string& path = file.to.path;
  const std::string title = file.to.title.empty() ? fs::path(path).stem().string() : file.to.title;
  if (const auto drawing = drawing_of(file.pieces, title, fs::path(path).extension().string()))
    return exporting::write_file(path, *drawing);
  const MeshDocument document = document_of(file.pieces, title);
  exporting::write_mesh_file(path, document, *formats::find_mesh_format(path), file.to.flavour);
}

ScadResult run_scad(const ScadRequest& request, Diagnostics& messages) {
  const solids::EvaluateOptions options{request.threads, request.keeps_empty, request.stop, request.progress};
  ScadResult result{solids::evaluate(request.tree, options, messages), {}};
  if (messages.has_errors()) return result;
  if (request.no_overlap)
    result.pieces = without_overlaps(result.pieces, options);
  else if (std::ranges::any_of(request.outputs, holds_several, &SolidsExport::path))
    warn_of_overlaps(result.pieces, request.tree ? request.tree->where : SourceRange{}, options, messages);
  std::vector<SolidsFile> files;
  for (const SolidsExport& output : request.outputs)
    for (SolidsFile& file : solids_files(result.pieces, output, options, messages)) files.push_back(std::move(file));
  if (request.before_writing && !request.outputs.empty()) request.before_writing();
  for (const SolidsFile& file : files) {
    write_solids_file(file);
    result.files.push_back(file.to.path);
  }
  return result;
}

}  // namespace ombre::compile
