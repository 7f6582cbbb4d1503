// Makes the scene of a picture from a design.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "design/design.h"
#include "design/sub_design_memory.h"
#include "render/camera.h"
#include "render/scene.h"
#include "render/section.h"

namespace ombre::compile {

// A plane of a cut. The part behind all planes of a cut is removed: where sign * (coordinate - mm) is greater than 0.
struct CutPlane {
  int axis = 2;
  double mm = 0;
  int sign = 1;
};
using Cut = std::vector<CutPlane>;

// Colours by a value instead of those of the materials.
struct ValueColours {
  std::string of;            // a material, for its fraction, or an attribute, which may be a colour itself
  Interval range;            // range that the colours span
  std::string palette = {};  // one of palettes(); empty: the default one
};

// The division of a picture for outlines and names: the parts of a design that has nodes of parts, or the materials.
enum class Divided : uint8_t { parts, materials };

struct SceneOptions {
  std::vector<Cut> cuts;
  std::optional<Box> box;                // only the inside of this box is shown
  std::map<MaterialId, double> opacity;  // 0 to 1, instead of the materials' own
  std::optional<ValueColours> value;     // if given, materials without an opacity here are opaque
  // If given, red is the part's or material's number over most_numbers, and everything is opaque.
  std::optional<Divided> numbers;
  int threads = 1;                            // for tables of many parts; 0: all cores
  design::SubDesignMemory* memory = nullptr;  // keeps such tables for other scenes; null: they are not kept
};

inline constexpr int most_numbers = 4096;

// Returns the box that the picture should hold: the design's, cut.
Box scene_box(const Box& design_box, const SceneOptions& options);

// Makes a scene; `box` holds everything that is shown. Returns nothing, and adds diagnostics, when the design does not
// fit into memory.
std::optional<render::Scene> make_scene(const design::Design& design, const Box& box, const render::Camera& camera,
                                        const SceneOptions& options, Diagnostics& diagnostics);

// Makes the section in the plane through the camera's target that faces it; all materials are opaque. Returns null, and
// adds diagnostics, when the design does not fit into memory.
std::shared_ptr<const render::Section> make_section(const design::Design& design, const render::Camera& camera,
                                                    const render::Film& film, const SceneOptions& options,
                                                    Diagnostics& diagnostics);

// Returns the materials that may occur in the box, alone or in mixtures, in ascending order. Tables of many parts are
// kept in the memory.
std::optional<std::vector<MaterialId>> materials_within(const design::Design& design, const Box& box, int threads,
                                                        Diagnostics& diagnostics,
                                                        design::SubDesignMemory* memory = nullptr);

}  // namespace ombre::compile
