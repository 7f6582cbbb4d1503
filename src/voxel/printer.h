// Printer profiles: what a machine expects of a slice stack, read from printers/*.json.
//
// A profile is one JSON object:
//
//   name                  lower-case letters, digits and '-'; also the file's name
//   title, source         for people: the machine, and where the figures come from
//   pitch                 {"x": P, "y": P, "z": P}; P is a length in mm as exact text ("25.4/600",
//                         "0.027"), a number of mm, or {"dpi": 600}. z is the layer height
//   build_mm              [x, y, z], the largest part; absent where the machine sets no limit
//   image                 "rgba" or "indexed", unless the job says otherwise
//   origin                "design": images cover the design's own box (default);
//                         "center": images cover the build plate, the part in its middle
//   flip                  axes that images run backwards on: a list of "x", "y" (default: none).
//                         Unflipped, x grows to the right and the top row has the greatest y
//   background            [r, g, b, a] of void, 0 ... 255 (default: all 0, transparent)
//   files                 file names with the layer's number, "slice_{index:05}.png": five digits or more
//   first_index           the number of the lowest layer (default 0)
//   empty_layers          "keep" (default) or "drop"; a dropped layer leaves its number unused
//   max_materials         the most materials in one job, void not counted, 1 ... 255
//   smallest_feature      {"distorts_mm": 0.42, "fails_mm": 0.21}; absent when unknown
//   forbidden_neighbours  [{"material": "liquid", "near": "surface", "within_mm": 0.3}, ...]; `near`
//                         is "surface" or another material
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/pitch.h"
#include "base/vec.h"

namespace ombre::voxel {

enum class ImageFormat { rgba, indexed };
enum class Placement { design, center };

// "slice_{index:05}.png": the names of the files of a stack.
class NamePattern {
 public:
  NamePattern() = default;
  // Nothing unless the text holds "{index}" or "{index:0N}" once, ends in ".png" and names a file
  // without a folder.
  static std::optional<NamePattern> parse(std::string_view text);

  std::string name(int64_t index) const;
  // The index whose name this is, if any.
  std::optional<int64_t> index(std::string_view name) const;
  std::string text() const;
  bool operator==(const NamePattern&) const = default;

 private:
  std::string before_ = "slice_", after_ = ".png";
  int digits_ = 5;
};

struct SmallestFeature {
  double distorts_mm = 0, fails_mm = 0;  // thinner than this
};

// Voxels of `material` may not lie within `within_mm` of the surface or of another material.
struct ForbiddenNeighbour {
  std::string material, near;
  double within_mm = 0;
};

struct Printer {
  std::string name, title, source;
  std::array<Pitch, 3> pitch;
  std::optional<Vec3> build_mm;
  ImageFormat image = ImageFormat::rgba;
  Placement origin = Placement::design;
  bool flip_x = false, flip_y = false;
  std::array<uint8_t, 4> background{};
  NamePattern files;
  int64_t first_index = 0;
  bool drop_empty_layers = false;
  int max_materials = 255;
  std::optional<SmallestFeature> smallest_feature;
  std::vector<ForbiddenNeighbour> forbidden_neighbours;
};

// Nothing, and diagnostics, when the text is not a profile.
std::optional<Printer> parse_printer(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace ombre::voxel
