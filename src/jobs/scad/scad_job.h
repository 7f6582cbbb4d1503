// Writes trees of polyhedral geometry to files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "formats/packages/package_writers.h"
#include "solids/evaluate_tree.h"

namespace ombre::compile {

struct SolidsExport {
  // The ending decides the format: one of meshes for solids; .svg and .dxf for regions. "{part}" in the name makes a
  // file for each part.
  std::string path;
  std::string title = {};  // empty: the file's name
  formats::SlicerFlavour flavour = formats::SlicerFlavour::generic;
};

// without_overlaps() subtracts from each solid those before it; warn_of_overlaps() warns if solids overlap.
solids::Pieces without_overlaps(const solids::Pieces& pieces, const solids::EvaluateOptions& options);
void warn_of_overlaps(const solids::Pieces& pieces, const SourceRange& where, const solids::EvaluateOptions& options,
                      Diagnostics& messages);

// A file that is ready to be written. Solids of a format that does not tell them apart are united.
struct SolidsFile {
  SolidsExport to;  // the path has a part's name in the place of "{part}"
  solids::Pieces pieces;
};

// Returns the files, in order. If the pieces do not fit the format, or a surface is not closed, it returns none and
// reports errors.
std::vector<SolidsFile> solids_files(const solids::Pieces& pieces, const SolidsExport& to,
                                     const solids::EvaluateOptions& options, Diagnostics& messages);
// Throws Error if the file cannot be written.
void write_solids_file(const SolidsFile& file);

// Returns bodies named by their parts, else by their materials or colours, with a material for each name and colour.
formats::MeshDocument document_of(const solids::Pieces& pieces, const std::string& title);

struct ScadRequest {
  solids::TreePtr tree;
  std::vector<SolidsExport> outputs;
  bool no_overlap = false;  // the first solid wins
  bool keeps_empty = false;
  int threads = 0;
  const StopFlag* stop = nullptr;
  Progress* progress = nullptr;
  std::function<void()> before_writing = {};  // called when the geometry is made, unless there is nothing to write
};

struct ScadResult {
  solids::Pieces pieces;
  std::vector<std::string> files;
};

// Evaluates and writes. After errors no file is written. Throws Error and Cancelled.
ScadResult run_scad(const ScadRequest& request, Diagnostics& messages);

}  // namespace ombre::compile
