// Printer profiles, which describe the slice stack that a machine expects, read from printers/*.json.
// docs/reference/printers.md lists the members of a profile.
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

namespace ombre {
struct MemberInfo;
template <class T>
class Record;
}  // namespace ombre

namespace ombre::voxel {

enum class Placement { design, center };
// Returns the names, in the order of the enumeration.
const std::vector<std::string>& placement_names();

// The names of the files of a stack. "slice_{index:05}.png" names one file for each layer,
// "slice_{index:05}_{material}.png" one file for each material of each layer.
class NamePattern {
 public:
  NamePattern() = default;
  // Returns nothing unless the text contains "{index}" or "{index:0N}" once, contains "{material}" at most once and
  // separated from it, ends with ".png" and names a file without a folder.
  static std::optional<NamePattern> parse(std::string_view text);

  bool has_material() const;
  // Returns the pattern with "_{material}" inserted before ".png" if it has no {material} yet.
  NamePattern with_material() const;
  // Returns the pattern with {material} replaced by this text.
  NamePattern of_material(std::string_view material) const;

  // Returns the name of a file. The pattern may not contain {material}.
  std::string name(int64_t index) const;
  // Returns the index of the file with this name, or nothing if the name does not match.
  std::optional<int64_t> index(std::string_view name) const;
  std::string text() const;
  bool operator==(const NamePattern&) const = default;

 private:
  bool is_sound() const;

  std::string before_ = "slice_", after_ = ".png";  // one of them may contain "{material}"
  int digits_ = 5;
};

struct SmallestFeature {
  double distorts_mm = 0, fails_mm = 0;  // thinner features distort or fail
};

// A rule that voxels of `material` may not lie within `within_mm` of the surface, or of another material.
struct ForbiddenNeighbour {
  std::string material, near;
  double within_mm = 0;
};

// A machine rounds a value to whole multiples of a step.
struct ValueStep {
  std::string of;  // an attribute, or "fractions"
  double size = 0;
};

// Light for the layers of a vat printer.
struct Exposure {
  double seconds = 0, first_seconds = 0;  // for a layer, for the first layer
  int fade_layers = 0;                    // layers after the first one whose times fall to the usual one
  std::optional<double> irradiance = {};  // of white, mW/cm2
  bool operator==(const Exposure&) const = default;
};

// Vats that take turns within a layer, one for each material, in the order of the job's materials.
struct Vats {
  double wash_seconds = 0;  // the part is washed so long between them
  bool operator==(const Vats&) const = default;
};

// Everything that determines the images of layers, except the voxels and the materials' colours.
struct Images : ImageLayout {
  std::array<uint8_t, 4> background{};  // colour of void
  NamePattern files;                    // names of the files; with {material} there is one file for each material
  int64_t first_index = 0;              // number of the lowest layer
  bool drop_empty_layers = false;
  std::optional<Exposure> exposure;  // in .sl1 archives
  std::optional<Vats> vats;          // in job.json
};

struct Printer : Images {
  std::string name, title, source;
  std::array<Pitch, 3> pitch;
  std::optional<Vec3> build_mm;
  Placement origin = Placement::design;
  int max_materials = 255;
  std::optional<SmallestFeature> smallest_feature;
  std::vector<ForbiddenNeighbour> forbidden_neighbours;
  std::optional<double> overhang_degrees;       // from the vertical, if layers are built on those below
  double gap_mm = 2;                            // between parts on a tray
  bool is_vat = false;                          // layers are made in a bath of resin
  std::vector<std::string> calibrations;        // names or paths of those that hold for the machine
  std::vector<std::string> needs{"fractions"};  // what it must know of a part: fractions of materials, attributes
  std::vector<ValueStep> steps;                 // of what it needs; it takes all other values as they are
};

// Read the light of layers, and vats, from a profile or a job.json.
Record<Exposure> exposure_record();
Record<Vats> vats_record();

// Returns the members of a profile, for its reference.
const std::vector<MemberInfo>& printer_members();

// Returns nothing and adds diagnostics if the text is not a valid profile.
std::optional<Printer> parse_printer(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace ombre::voxel
