// From a design to what a picture of it shows.
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

// What lies behind all planes of a cut is left away: where sign * (coordinate - mm) is greater than 0.
struct CutPlane {
  int axis = 2;
  double mm = 0;
  int sign = 1;
};
using Cut = std::vector<CutPlane>;

// Colours by a value in place of those of the materials.
struct ValueColours {
  std::string of;            // a material, for its fraction, or an attribute, which may be a colour itself
  Interval range;            // that the colours span
  std::string palette = {};  // one of palettes(); empty: the usual one
};

// What pictures are divided by, for outlines and names: the parts of a design with its nodes of parts, or the
// materials.
enum class Divided : uint8_t { parts, materials };

struct SceneOptions {
  std::vector<Cut> cuts;
  std::optional<Box> box;                // only what is within
  std::map<MaterialId, double> opacity;  // 0 to 1, in place of the materials' own
  std::optional<ValueColours> value;     // then materials without an opacity here are opaque
  std::optional<Divided> numbers;        // then red is the part's or material's number over most_numbers, all is opaque
  int threads = 1;                       // that make tables of many parts; 0: all cores
  design::SubDesignMemory* memory = nullptr;  // where such tables are kept for other scenes; null: nowhere
};

inline constexpr int most_numbers = 4096;

// The box that the picture should hold: the design's, cut.
Box scene_box(const Box& design_box, const SceneOptions& options);

// `box` holds all that is to be seen. Nothing, and diagnostics, when the design does not fit into memory.
std::optional<render::Scene> make_scene(const design::Design& design, const Box& box, const render::Camera& camera,
                                        const SceneOptions& options, Diagnostics& diagnostics);

// Of the plane through the camera's target that faces it; all materials are opaque. Null, and diagnostics, like above.
std::shared_ptr<const render::Section> make_section(const design::Design& design, const render::Camera& camera,
                                                    const render::Film& film, const SceneOptions& options,
                                                    Diagnostics& diagnostics);

// Those that may occur in the box, alone or in mixtures; ascending. Tables of many parts are kept in the memory.
std::optional<std::vector<MaterialId>> materials_within(const design::Design& design, const Box& box, int threads,
                                                        Diagnostics& diagnostics,
                                                        design::SubDesignMemory* memory = nullptr);

}  // namespace ombre::compile
