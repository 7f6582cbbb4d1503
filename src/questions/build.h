// Makes programs from designs, step by step.
#pragma once

#include <optional>

#include "design/design.h"
#include "questions/question.h"
#include "voxel/layers.h"

namespace ombre::compile {

// A program that computes membership and composition; its bodies are still called.
struct Built {
  voxel::MaterialProgram materials;
  std::vector<design::Check> checks;  // one for each check output of the program
};
// Builds the program on up to `threads` threads; 0: all cores.
Built build_program(const design::Design& design, int threads = 1);

// Calls build_program and makes the program ready to be evaluated. Returns nothing, and adds a diagnostic, if it would
// not fit into memory. A memory keeps tables of many parts.
std::optional<Built> build_flat_program(const design::Design& design, Diagnostics& diagnostics, int threads = 1,
                                        design::SubDesignMemory* memory = nullptr);

// Builds a program of the shape alone, without calls and all of the first material. Returns nothing, and adds a
// diagnostic, if it would not fit into memory.
std::optional<voxel::MaterialProgram> build_inside_program(const design::Design& design, Diagnostics& diagnostics);

// Removes materials and checks that cannot occur within the box, and the code that only they needed. One material
// stays.
void leave_out_impossible(Built& built, const Box& box, int threads);

// Returns the place of the design: the box that is sampled, or the bounds of its solids. Returns nothing, and adds
// diagnostics, when it is empty or has no bounds.
std::optional<Box> design_box(const design::Design& design, Diagnostics& diagnostics);

}  // namespace ombre::compile
