// Makes the sections of a finite-element model from the materials of its elements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fea/model/model.h"
#include "fea/model/study.h"
#include "load/loaded.h"

namespace ombre::compile {

struct FeaRequest {
  enum class Assign : uint8_t {
    draw,  // one material for each element, drawn with the odds of its fractions, by the plan's dither and seed
    mix,   // mean properties, by the fractions (Voigt)
  };
  enum class Fill : uint8_t {
    exact,   // bricks are stiff and heavy by their part inside
    centre,  // bricks are whole if their centre is inside
  };
  Assign assign = Assign::draw;
  Fill fill = Fill::exact;
  std::optional<std::string> modulus =
      {};  // an attribute that is Young's modulus in MPa; default: that of the materials
  std::optional<std::string> conductivity = {};  // an attribute that is the conductivity, W/(m K) or S/m
  size_t most_sections = 64;                     // greatest number of sections of mean properties
  int threads = 0;
};

// Fields of fractions have this and the material's name as their name.
inline constexpr std::string_view fraction_prefix = "fraction of ";

// The materials of elements.
struct ElementMaterials {
  size_t count = 0;                   // number of elements
  std::vector<MaterialId> drawn;      // one material for each element
  std::vector<MaterialId> fractions;  // the materials of the first fields
  const std::vector<fea::ValueField>* fields = nullptr;
};

struct Sections {
  std::vector<fea::Section> sections;
  std::vector<uint16_t> section_of;
};

// Makes sections. Properties of the study take precedence over those of the materials file. Returns nothing, and adds
// diagnostics, when some are missing, or an attribute gives none.
std::optional<Sections> make_sections(const Loaded& loaded, const fea::Study& study, const FeaRequest& request,
                                      const ElementMaterials& materials, Diagnostics& diagnostics);

}  // namespace ombre::compile
