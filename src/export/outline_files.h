// Writes outlines of layers: one file per layer, or one for all.
#pragma once

#include <memory>
#include <string>

#include "formats/drawings/cli.h"
#include "formats/drawings/outlines.h"

namespace ombre::exporting {

// Files that appear only when they are committed. All functions throw Error.
class OutlineFiles {
 public:
  virtual ~OutlineFiles() = default;
  // Adds the next layer; `z_mm` is the height at which it is cut, `top_mm` that of its upper face.
  virtual void add(double z_mm, double top_mm, const formats::OutlinePolygons& polygons) = 0;
  virtual void commit() = 0;
};

enum class OutlineFormat { svg, svg_folder, cli };
// Returns the format of a path by its ending: .cli, .svg, or otherwise a folder.
OutlineFormat outline_format_of(const std::string& path);

struct OutlineTarget {
  std::string path;
  OutlineFormat format = OutlineFormat::svg_folder;
  uint64_t layers = 0;
  double bottom_mm = 0;  // height at which the first layer begins
  formats::CliRules cli = {};
};

// Begins writing. A missing folder is created; its files are layer_0000.svg and so on. Layer files of an earlier run
// are removed when the new ones are committed. The document must outlive the result.
std::unique_ptr<OutlineFiles> begin_outline_files(const OutlineTarget& target,
                                                  const formats::OutlineDocument& document);

// Returns true if a folder contains files with names of layers.
bool has_outline_layers(const std::string& folder);

}  // namespace ombre::exporting
