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

// The plan of a model of bricks: a lattice whose voxels may become bricks, and a finer one of their parts, which shows
// how full each is. The finer one is missing if centres decide.
struct BrickPlan {
  Plan bricks;
  std::optional<Plan> parts;
};

// Plans a model; returns nothing, and adds diagnostics, in the cases of plan_slice.
std::optional<BrickPlan> plan_model(const LoadedPtr& loaded, const PlanOptions& options, FeaRequest::Fill fill,
                                    Diagnostics& diagnostics);

// Makes a model. Its bricks are the voxels of which at least fea::least_fill is inside, or, without parts, whose centre
// is. Their fields are the fractions of materials and the attributes at their centre, or, if that is outside, at the
// place nearest to the centroid of the part inside. Properties of the study take precedence over those of the materials
// file. Returns nothing, and adds diagnostics, when there is no brick, or properties are missing. Throws Cancelled.
std::optional<fea::Model> fea_model(const LoadedPtr& loaded, const BrickPlan& plan, const fea::Study& study,
                                    const FeaRequest& request, Diagnostics& diagnostics, Progress* progress = nullptr,
                                    const StopFlag* stop = nullptr);

// The results of a solver for the study's physics, if any.
struct FeaResults {
  std::optional<fea::Solution> solution;
  std::optional<fea::Stresses> stresses;  // stresses of the solution
  std::optional<fea::Conduction> conduction;
};

// Returns the fields of elements: those of the model and its main property; with a solution also stress, von Mises
// stress and strain in the middle, and the greatest von Mises stress at integration points, or the flux.
std::vector<fea::ValueField> fea_element_fields(const fea::ModelView& model, fea::Physics physics,
                                                const FeaResults& results);
// Returns the fields of nodes: displacements and recovered stresses, or temperatures or potentials; none without a
// solution.
std::vector<fea::ValueField> fea_node_fields(fea::Physics physics, const FeaResults& results);

}  // namespace ombre::compile
