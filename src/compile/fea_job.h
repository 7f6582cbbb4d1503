// Makes finite-element models of designs, and fields of models and solutions.
#pragma once

#include <optional>
#include <string>

#include "compile/load.h"
#include "fea/elastic.h"
#include "fea/model.h"
#include "fea/study.h"

namespace ombre::compile {

struct FeaRequest {
  enum class Assign : uint8_t {
    draw,  // of each brick's mixture one material, with the odds of its fractions, by the plan's dither and seed
    mix,   // mean properties, by the fractions (Voigt)
  };
  Assign assign = Assign::draw;
  std::optional<std::string> modulus;  // an attribute that is Young's modulus in MPa; else that of the materials
  size_t most_sections = 64;           // bricks of mean properties are gathered into so many
  int threads = 0;
};

// Bricks are those voxels of the plan's lattice whose centre is inside; their fields are the fractions of materials and
// the attributes there. Properties are those of the study, then those of the materials file. Nothing, and diagnostics,
// when there is no brick, or properties are missing. Throws Cancelled.
std::optional<fea::Model> fea_model(const LoadedPtr& loaded, const Plan& plan, const fea::Study& study,
                                    const FeaRequest& request, Diagnostics& diagnostics, Progress* progress = nullptr,
                                    const StopFlag* stop = nullptr);

// The fields of bricks: those of the model, its modulus, and with a solution stress, von Mises' stress and strain.
std::vector<fea::ValueField> fea_brick_fields(const fea::Model& model, const fea::Solution* solution);
// The displacements of nodes; none without a solution.
std::vector<fea::ValueField> fea_node_fields(const fea::Solution* solution);

}  // namespace ombre::compile
