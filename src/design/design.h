// A design: materials, parts, and optionally a box to sample. Every front end makes one, every job takes one.
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

// The sampling that `root` declares: the box and the voxel size, in mm.
struct Sampling {
  Box box;
  std::array<Pitch, 3> pitch;
};

// Name of the part that front ends make of solids outside named parts.
inline constexpr const char* nameless_part = "part";

struct Design {
  MaterialTable materials;
  std::vector<Part> parts;  // at least one; parts may overlap
  std::optional<Sampling> sampling;

  // Resolution of the current job, for nodes whose precision depends on it. It is not part of the design: neither the
  // file nor the hash contains it.
  std::optional<JobScale> job_scale = {};
  // The current job's voxel lattice and the host that makes its stages; not part of the design either.
  std::optional<StageLattice> job_lattice = {};
  std::shared_ptr<StageHost> stages = {};

  std::vector<NodePtr> roots() const;
  // Returns the job's scale, else that of the design's sampling, else nothing.
  std::optional<JobScale> scale() const;
  // Returns the job's lattice, else that of the design's sampling, else nothing.
  std::optional<StageLattice> lattice() const;
};

Design for_job(Design design, const JobScale& scale);
Design for_lattice(Design design, const StageLattice& lattice);

// Returns the design file: format, version, materials, sampling, nodes (each once), parts.
Data to_data(const Design& design);
// Reads a design file. Returns nothing and adds diagnostics with positions if it is wrong: unknown types, wrong values,
// missing or circular references.
std::optional<Design> read_design(const Data& data, const Registry& registry, SourceLoader* loader,
                                  Diagnostics& diagnostics);

// Hashes the design file with defaults filled in. Names of variables, node ids and positions do not count; files are
// identified by their content.
Hash hash(const Design& design);

// Returns a node with a parameter that the host program computes, or null. Such designs are not saved and their jobs
// are not resumed, since nothing tells whether two runs mean the same function.
const Node* find_host_function(const Design& design);

// Checks that indices of cells are used only below nodes that repeat space, and that each attribute has a single type.
// Returns false and adds diagnostics if not.
bool check_design(const Design& design, Diagnostics& diagnostics);

// Returns an indented tree for people, with each solid's kind of distance. Shared nodes are printed once.
std::string to_tree(const Design& design);

}  // namespace ombre::design
