// From designs to programs, step by step.
#pragma once

#include <optional>

#include "design/design.h"
#include "questions/question.h"
#include "voxel/layers.h"

namespace ombre::compile {

// The program that says what is inside and of which composition, with its bodies still called.
struct Built {
  voxel::MaterialProgram materials;
  std::vector<design::Check> checks;  // of the program's check outputs
};
// On up to `threads` threads; 0: all cores.
Built build_program(const design::Design& design, int threads = 1);

// build_program, ready to be evaluated. Nothing, and a diagnostic, when it would not fit into memory.
// A memory keeps tables of many parts.
std::optional<Built> build_flat_program(const design::Design& design, Diagnostics& diagnostics, int threads = 1,
                                        design::SubDesignMemory* memory = nullptr);

// The shape alone, without calls and all of the first material. Nothing, and a diagnostic, like above.
std::optional<voxel::MaterialProgram> build_inside_program(const design::Design& design, Diagnostics& diagnostics);

// Leaves out materials and checks that cannot occur within the box, and what only they needed. One material stays.
void leave_out_impossible(Built& built, const Box& box, int threads);

// Where the design lies: the box that is sampled, or the bounds of its solids. Nothing, and diagnostics,
// when it is empty or has no bounds.
std::optional<Box> design_box(const design::Design& design, Diagnostics& diagnostics);

}  // namespace ombre::compile
