// Makes finite-element models of designs, and fields of models and solutions.
#pragma once

#include <optional>
#include <string>

#include "fea/model/model.h"
#include "fea/model/study.h"
#include "fea/solve/conduction.h"
#include "fea/solve/elastic.h"
#include "fea/solve/stresses.h"
#include "jobs/fea/fea_sections.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

// The voxels of a lattice may become bricks. A finer lattice of their parts says how full each is; where bricks go by
// their centres, there is none.
struct BrickPlan {
  Plan bricks;
  std::optional<Plan> parts;
};

// Nothing, and diagnostics, as plan_slice.
std::optional<BrickPlan> plan_model(const LoadedPtr& loaded, const PlanOptions& options, FeaRequest::Fill fill,
                                    Diagnostics& diagnostics);

// Bricks are those voxels of which at least fea::least_fill is inside, or, without parts, whose centre is. Their fields
// are the fractions of materials and the attributes in their centre, or, where that is outside, at the place nearest to
// the middle of what is inside. Properties are those of the study, then those of the materials file. Nothing, and
// diagnostics, when there is no brick, or properties are missing. Throws Cancelled.
std::optional<fea::Model> fea_model(const LoadedPtr& loaded, const BrickPlan& plan, const fea::Study& study,
                                    const FeaRequest& request, Diagnostics& diagnostics, Progress* progress = nullptr,
                                    const StopFlag* stop = nullptr);

// What a solver found: nothing, or what belongs to the study's physics.
struct FeaResults {
  std::optional<fea::Solution> solution;
  std::optional<fea::Stresses> stresses;  // of the solution
  std::optional<fea::Conduction> conduction;
};

// The fields of elements: those of the model, its main property, and with a solution stress, von Mises' stress and
// strain in the middle, and the greatest von Mises stress at integration points; or the flux.
std::vector<fea::ValueField> fea_element_fields(const fea::ModelView& model, fea::Physics physics,
                                                const FeaResults& results);
// The displacements and recovered stresses, temperatures or potentials of nodes; none without a solution.
std::vector<fea::ValueField> fea_node_fields(fea::Physics physics, const FeaResults& results);

}  // namespace ombre::compile
