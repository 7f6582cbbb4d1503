// The sections of a finite-element model: what its elements are made of.
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
    draw,  // of each element's mixture one material, with the odds of its fractions, by the plan's dither and seed
    mix,   // mean properties, by the fractions (Voigt)
  };
  enum class Fill : uint8_t {
    exact,   // bricks are stiff and heavy by what is inside of them
    centre,  // bricks are whole where their centre is inside
  };
  Assign assign = Assign::draw;
  Fill fill = Fill::exact;
  std::optional<std::string> modulus = {};  // an attribute that is Young's modulus in MPa; else that of the materials
  std::optional<std::string> conductivity = {};  // the same of conduction, W/(m K) or S/m
  size_t most_sections = 64;                     // elements of mean properties are gathered into so many
  int threads = 0;
};

// Fields of fractions are called by this and the material's name.
inline constexpr std::string_view fraction_prefix = "fraction of ";

// What elements are made of.
struct ElementMaterials {
  size_t count = 0;                   // of elements
  std::vector<MaterialId> drawn;      // one for each element
  std::vector<MaterialId> fractions;  // the materials of the first fields
  const std::vector<fea::ValueField>* fields = nullptr;
};

struct Sections {
  std::vector<fea::Section> sections;
  std::vector<uint16_t> section_of;
};

// Properties are those of the study, then those of the materials file. Nothing, and diagnostics, when some are missing,
// or an attribute gives none.
std::optional<Sections> make_sections(const Loaded& loaded, const fea::Study& study, const FeaRequest& request,
                                      const ElementMaterials& materials, Diagnostics& diagnostics);

}  // namespace ombre::compile
