// Outlines of layers as files: one for each layer, or one for all.
#pragma once

#include <memory>
#include <string>

#include "formats/drawings/outlines.h"

namespace ombre::exporting {

// Files that appear when they are committed, and not at all if they are not. All throw Error.
class OutlineFiles {
 public:
  virtual ~OutlineFiles() = default;
  // Layers come in order; `z_mm` is where they are cut, `top_mm` their upper faces.
  virtual void add(double z_mm, double top_mm, const formats::OutlinePolygons& polygons) = 0;
  virtual void commit() = 0;
};

enum class OutlineFormat { svg, svg_folder, cli };
// By the path's ending: .cli, .svg, or else a folder.
OutlineFormat outline_format_of(const std::string& path);

struct OutlineTarget {
  std::string path;
  OutlineFormat format = OutlineFormat::svg_folder;
  uint64_t layers = 0;
  double bottom_mm = 0;  // where the first layer begins
};

// A folder is made if it is missing; its files are layer_0000.svg and so on. Other layers that an earlier run left
// there go when the new ones are committed. The document must live as long.
std::unique_ptr<OutlineFiles> begin_outline_files(const OutlineTarget& target,
                                                  const formats::OutlineDocument& document);

// Whether a folder has files named as the layers are.
bool has_outline_layers(const std::string& folder);

}  // namespace ombre::exporting
