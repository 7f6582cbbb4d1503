// The sequence of passes that prepares a program for evaluation.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "program/program.h"

namespace ombre::program {

// The evaluation for which a program in double precision is prepared.
enum class Purpose : uint8_t {
  ranges,  // ranges of values in boxes, as batches would compute them
  batch,   // batches of voxels
  rays,    // batches along the rays of a picture, whose inputs are mapped first
};

struct Pass {
  std::string_view name, sentence;
  Program (*run)(const Program&);
};

std::span<const Pass> passes_for(Purpose purpose);

// Runs all passes for the purpose. If `after` is given, it is called with the result of each pass.
Program prepare(const Program& program, Purpose purpose,
                const std::function<void(const Pass& pass, const Program& made)>& after = nullptr);

}  // namespace ombre::program
