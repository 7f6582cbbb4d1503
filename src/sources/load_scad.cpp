// Loads OpenSCAD scripts for designs.
#include <algorithm>

#include "base/text/text.h"
#include "lang/openscad/colours.h"
#include "lang/openscad/definitions.h"
#include "lang/openscad/run_script.h"
#include "lang/openscad/script_diagnostics.h"
#include "solids/colour_bytes.h"
#include "solids/content.h"
#include "solids/evaluate_tree.h"
#include "solids/kernel.h"
#include "sources/loading.h"
#include "sources/mesh_materials.h"
#include "sources/solid_parts.h"

namespace ombre::design {
namespace {

namespace openscad = lang::openscad;
using Loading = sources::Loading;

// Returns the script. If it is the text that contains the request, which may be edited and not saved, that text is
// used.
SourcePtr script_of(const ScadRequest& request, Loading& loading) {
  if (!request.script.empty()) return make_source(request.file.path, request.script);
  const SourcePtr& around = loading.reader().where.source;
  if (around && around->name() == request.file.path) return around;
  return make_source(request.file.path, *loading.bytes(request.file));
}

// Returns the variables as assignments. Null, with a diagnostic, if OpenSCAD has no such value.
std::optional<std::vector<std::string>> definitions_of(const ScadRequest& request, const SourcePtr& script,
                                                       const Reader& reader) {
  std::vector<std::string> definitions;
  for (const auto& [name, value] : request.variables.values) {
    const SourceRange& where = value.where.source ? value.where : reader.where;
    const auto definition = openscad::definition_of(name, value);
    if (!definition) {
      reader.diagnostics.error(
          where, "the script \"" + request.file.path + "\" cannot get " + describe(value) + " for \"" + name + '"',
          "give it a number, a text, true, false, or a list of them");
      return std::nullopt;
    }
    if (!name.starts_with('$') && !openscad::mentions(script, name))
      reader.diagnostics.warning(where, "the script \"" + request.file.path + "\" has no variable \"" + name + '"');
    definitions.push_back(*definition);
  }
  return definitions;
}

// Adds diagnostics. For a script given as text rather than as a file, their place is that of the call.
void add_with_places(const Diagnostics& found, const ScadRequest& request, const Reader& reader) {
  for (Diagnostic diagnostic : found.list()) {
    if (!request.script.empty()) diagnostic.where = reader.where;
    reader.diagnostics.add(std::move(diagnostic));
  }
}

// Returns the tree that the script makes; null, with diagnostics, if an error stops it.
solids::TreePtr tree_of(const ScadRequest& request, Loading& loading) {
  const Reader& reader = loading.reader();
  const SourcePtr script = script_of(request, loading);
  auto definitions = definitions_of(request, script, reader);
  if (!definitions) return nullptr;
  openscad::Options options;
  options.definitions = std::move(*definitions);
  options.libraries = openscad::library_folders();
  options.stop = loading.stop();
  options.read_file = [&](const std::string& path) { return loading.included(path); };
  options.is_preview = false;
  openscad::Messages messages;
  solids::TreePtr tree = openscad::run(script, options, messages);
  Diagnostics found;
  openscad::add_diagnostics(messages, script, reader.where, found);
  add_with_places(found, request, reader);
  return messages.error_count() > 0 ? nullptr : tree;
}

// Adds everything that determines the geometry of a tree to the key. Returns false, with a diagnostic, if an imported
// file cannot be read.
bool add_tree(sources::Key& key, const solids::Tree& tree, Loading& loading) {
  key.add(solids::text_of(tree)).add(static_cast<double>(tree.children.size()));
  const auto add_file = [&](const std::string& path) {
    FilePath file{path, {}};
    if (!loading.read_content(file)) return false;
    key.add(file.content);
    return true;
  };
  if (const auto* import = std::get_if<solids::Import>(&tree.operation); import && !add_file(import->path))
    return false;
  if (const auto* surface = std::get_if<solids::Surface>(&tree.operation); surface && !add_file(surface->path))
    return false;
  return std::ranges::all_of(tree.children,
                             [&](const solids::TreePtr& child) { return add_tree(key, *child, loading); });
}

size_t bytes_of(const solids::Pieces& pieces) {
  constexpr size_t per_triangle = 400;  // including the kernel's exact coordinates
  size_t bytes = 0;
  for (const solids::Piece& piece : pieces)
    if (piece.solid()) bytes += per_triangle * piece.solid()->mesh().triangles.size();
  return bytes;
}

std::shared_ptr<const solids::Pieces> pieces_of(const solids::TreePtr& tree, const ScadRequest& request,
                                                Loading& loading) {
  sources::Key key("scad");
  if (!add_tree(key, *tree, loading)) return nullptr;
  const solids::EvaluateOptions options{loading.threads(), false, loading.stop(), nullptr};
  return loading.cached<solids::Pieces>(key.hash(), request.file.path, [&](const Reader& reader) {
    Diagnostics found;
    auto pieces = std::make_shared<const solids::Pieces>(solids::evaluate(tree, options, found));
    add_with_places(found, request, reader);
    const size_t bytes = bytes_of(*pieces);
    return Loading::Made<solids::Pieces>{std::move(pieces), bytes};
  });
}

std::vector<std::string> part_names(const solids::Pieces& pieces) {
  std::vector<std::string> names;
  for (const solids::Piece& piece : pieces)
    if (piece.solid() && std::ranges::find(names, piece.attributes.part) == names.end())
      names.push_back(piece.attributes.part);
  return names;
}

// Returns false, with diagnostics, if there is nothing that can be printed. A script given as text may be empty.
bool check_pieces(const ScadRequest& request, const solids::Pieces& pieces, const Reader& reader) {
  const bool has_areas = std::ranges::any_of(pieces, [](const solids::Piece& piece) { return !piece.solid(); });
  const bool has_solids = std::ranges::any_of(pieces, [](const solids::Piece& piece) { return piece.solid(); });
  const std::string name = '"' + request.file.path + '"';
  if (has_areas && !has_solids)
    reader.diagnostics.error(Code::file_content, reader.where, name + " makes areas, not solids",
                             "give them a height by linear_extrude()", {{"file", name}});
  else if (has_areas)
    reader.diagnostics.warning(reader.where, name + " makes areas beside its solids; they are left out",
                               "give them a height by linear_extrude()");
  else if (!has_solids && request.script.empty())
    reader.diagnostics.error(Code::nothing_inside, reader.where, name + " makes no solid");
  return has_solids || (!has_areas && !request.script.empty());
}

std::optional<Rgba> colour_of(const solids::Piece& piece) {
  const auto& colour = piece.attributes.colour;
  return piece.solid() && colour ? std::optional(solids::bytes_of(*colour)) : std::nullopt;
}

bool means(const MaterialForName& entry, const solids::Piece& piece) {
  return piece.solid() && sources::means(entry.name, piece.attributes.material, colour_of(piece));
}

Choice materials_of(const ScadRequest& request, const solids::Pieces& pieces) {
  if (request.materials != "auto") return request.materials;
  const auto any = [&](auto has) { return std::ranges::any_of(pieces, has); };
  if (any([](const solids::Piece& piece) { return !piece.attributes.material.empty(); })) return "names";
  return any([](const solids::Piece& piece) { return piece.attributes.colour.has_value(); }) ? "colours" : "one";
}

// Returns the names that a material map may have: those of materials, then colours.
std::vector<std::string> material_names(const solids::Pieces& pieces) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const solids::Piece& piece : pieces) add(piece.attributes.material);
  for (const solids::Piece& piece : pieces)
    if (const auto colour = colour_of(piece)) add(openscad::colour_name(*colour));
  return names;
}

// Returns false, with diagnostics, if the material map has names that no solid of the script has.
bool check_map(const ScadRequest& request, const solids::Pieces& pieces, const Reader& reader) {
  bool good = true;
  for (const MaterialForName& entry : request.material_map) {
    if (std::ranges::any_of(pieces, [&](const solids::Piece& piece) { return means(entry, piece); })) continue;
    good = false;
    reader.diagnostics.error(Code::unknown_material, reader.where,
                             "the script \"" + request.file.path + "\" has no material or colour \"" + entry.name + '"',
                             sources::hint_of_names(entry.name, material_names(pieces),
                                                    "its solids have none: leave the names of materials out"),
                             {{"material", entry.name}});
  }
  return good;
}

// Returns the entries of the material map for these solids.
std::vector<MaterialForName> map_for(const ScadRequest& request, const solids::Pieces& pieces) {
  std::vector<MaterialForName> entries = request.material_map;
  std::erase_if(entries, [&](const MaterialForName& entry) {
    return std::ranges::none_of(pieces, [&](const solids::Piece& piece) { return means(entry, piece); });
  });
  return entries;
}

solids::Pieces of_part(const ScadRequest& request, const solids::Pieces& pieces, const Reader& reader) {
  if (request.part.empty()) return pieces;
  solids::Pieces own;
  for (const solids::Piece& piece : pieces)
    if (part_word(piece.attributes.part) == request.part) own.push_back(piece);
  if (!own.empty()) return own;
  std::vector<std::string> names = part_names(pieces);
  std::erase(names, "");
  reader.diagnostics.error(Code::unknown_part, reader.where,
                           '"' + request.file.path + "\" has no part \"" + request.part + '"',
                           sources::hint_of_names(request.part, names, "its solids have no parts: leave part out"),
                           {{"part", request.part}});
  return own;
}

}  // namespace

std::shared_ptr<const ScadSolids> ScadRequest::load(sources::Loading& loading) {
  const Reader& reader = loading.reader();
  if (!solids::has_kernel()) {
    reader.diagnostics.error(Code::library_missing, reader.where,
                             "OpenSCAD scripts cannot be used: " + solids::without_kernel());
    return nullptr;
  }
  if (script.empty() && (!loading.find(file) || !loading.read_content(file))) return nullptr;
  const solids::TreePtr tree = tree_of(*this, loading);
  const auto pieces = tree ? pieces_of(tree, *this, loading) : nullptr;
  if (!pieces || !check_pieces(*this, *pieces, reader) || !check_map(*this, *pieces, reader)) return nullptr;
  if (pieces->empty()) return std::make_shared<const ScadSolids>();
  solids::Pieces own = of_part(*this, *pieces, reader);
  std::erase_if(own, [](const solids::Piece& piece) { return !piece.solid(); });
  if (own.empty()) return nullptr;
  const MeshUse use{"", "nonzero", materials_of(*this, own), material, map_for(*this, own)};
  return sources::scad_solids(own, file.path, use, loading);
}

}  // namespace ombre::design
