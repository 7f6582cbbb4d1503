// Printer profiles: what a machine expects of a slice stack, read from printers/*.json.
//
// A profile is one JSON object:
//
//   name                  lower-case letters, digits and '-'; also the file's name
//   title, source         for people: the machine, and where the figures come from
//   pitch                 {"x": P, "y": P, "z": P}; P is a length in mm as exact text ("25.4/600",
//                         "0.027"), a number of mm, or {"dpi": 600}. z is the layer height
//   build_mm              [x, y, z], the largest part; absent where the machine sets no limit
//   image                 unless the job says otherwise: "rgba" or "indexed", the materials' colours;
//                         "gray", 8 bits, the brightness of these colours; "mask", 1 bit, one file for each
//                         material, white where it is
//   origin                "design": images cover the design's own box (default);
//                         "center": images cover the build plate, the part in its middle
//   flip                  axes that images run backwards on: a list of "x", "y" (default: none).
//                         Unflipped, x grows to the right and the top row has the greatest y
//   background            [r, g, b, a] of void, 0 ... 255 (default: all 0, transparent)
//   files                 file names with the layer's number, "slice_{index:05}.png": five digits or more.
//                         With {material} as well, "slice_{index:05}_{material}.png", each layer has one file
//                         for each material, in which the others are void
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

#include "base/math/image_layout.h"
#include "base/math/pitch.h"
#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::voxel {

enum class Placement { design, center };
// In the order of the values.
const std::vector<std::string>& placement_names();

// As profiles and command lines write them, in the order of ImageFormat.
const std::vector<std::string>& image_format_names();
std::optional<ImageFormat> image_format(std::string_view name);
const std::string& to_text(ImageFormat format);

// "slice_{index:05}.png": the names of the files of a stack. "slice_{index:05}_{material}.png" names a file
// for each material of each layer.
class NamePattern {
 public:
  NamePattern() = default;
  // Nothing unless the text holds "{index}" or "{index:0N}" once, "{material}" at most once and apart from
  // it, ends in ".png" and names a file without a folder.
  static std::optional<NamePattern> parse(std::string_view text);

  bool has_material() const;
  // With "_{material}" before ".png" where there is no {material} yet.
  NamePattern with_material() const;
  // With this text in the place of {material}.
  NamePattern of_material(std::string_view material) const;

  // Of a pattern without {material}.
  std::string name(int64_t index) const;
  // The index whose name this is, if any.
  std::optional<int64_t> index(std::string_view name) const;
  std::string text() const;
  bool operator==(const NamePattern&) const = default;

 private:
  bool is_sound() const;

  std::string before_ = "slice_", after_ = ".png";  // one of them may hold "{material}"
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

// Everything that decides the images of layers, but for the voxels and the materials' colours.
struct Images : ImageLayout {
  std::array<uint8_t, 4> background{};  // void's colour
  NamePattern files;                    // with {material}: a file for each
  int64_t first_index = 0;              // of the lowest layer
  bool drop_empty_layers = false;
};

struct Printer : Images {
  std::string name, title, source;
  std::array<Pitch, 3> pitch;
  std::optional<Vec3> build_mm;
  Placement origin = Placement::design;
  int max_materials = 255;
  std::optional<SmallestFeature> smallest_feature;
  std::vector<ForbiddenNeighbour> forbidden_neighbours;
};

// Nothing, and diagnostics, when the text is not a profile.
std::optional<Printer> parse_printer(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace ombre::voxel
