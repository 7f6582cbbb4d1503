// A design: materials, parts, perhaps a box to sample; what every front end makes and every job takes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "base/system/hash.h"
#include "design/registry.h"
#include "design/stage.h"

namespace ombre::design {

struct Part {
  std::string name;
  NodePtr solid;
};

// What `root` gives: the box to sample and the voxel size, mm.
struct Sampling {
  Box box;
  std::array<Pitch, 3> pitch;
};

// The name that front ends give what stands in no named part.
inline constexpr const char* nameless_part = "part";

struct Design {
  MaterialTable materials;
  std::vector<Part> parts;  // at least one; they may overlap
  std::optional<Sampling> sampling;

  // Of the job at hand, for nodes that are made as finely as it asks for. No part of the design: neither its file nor
  // its hash has it.
  std::optional<JobScale> job_scale = {};
  // The same of the job's voxels, and of what makes stages.
  std::optional<StageLattice> job_lattice = {};
  std::shared_ptr<StageHost> stages = {};

  std::vector<NodePtr> roots() const;
  // The job's, else that of the voxels to sample; nothing when neither is known.
  std::optional<JobScale> scale() const;
  // The job's, else that of the voxels to sample; nothing when neither is known.
  std::optional<StageLattice> lattice() const;
};

Design for_job(Design design, const JobScale& scale);
Design for_lattice(Design design, const StageLattice& lattice);

// The design file: format, version, materials, sampling, nodes (each once), parts.
Data to_data(const Design& design);
// Nothing, and diagnostics with places, when it is wrong: unknown types, wrong values, missing or circular references.
std::optional<Design> read_design(const Data& data, const Registry& registry, SourceLoader* loader,
                                  Diagnostics& diagnostics);

// Over the design file's form with defaults filled in; names of variables, node ids and places left
// out, files named by their content.
Hash hash(const Design& design);

// A node with a parameter that the host program computes, or null. Nothing tells whether two runs mean the same
// function, so such designs are not saved, and their jobs are not resumed.
const Node* find_host_function(const Design& design);

// Are the indices of cells used only below what repeats, and is each attribute of one type? Else diagnostics say where.
bool check_design(const Design& design, Diagnostics& diagnostics);

// An indented tree for people, with each solid's kind of distance; shared nodes are printed once.
std::string to_tree(const Design& design);

}  // namespace ombre::design
