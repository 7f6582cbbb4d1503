// Which passes a program goes through before it is evaluated, and in which order.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "program/program.h"

namespace ombre::program {

// What a program in double precision is prepared for.
enum class Purpose : uint8_t {
  ranges,  // its values in boxes, as batches would compute them
  batch,   // batches of voxels
  rays,    // batches along the rays of a picture, whose inputs are mapped first
};

struct Pass {
  std::string_view name, sentence;
  Program (*run)(const Program&);
};

std::span<const Pass> passes_for(Purpose purpose);

// Runs all passes for the purpose. `after`, if given, is called with what each of them made.
Program prepare(const Program& program, Purpose purpose,
                const std::function<void(const Pass& pass, const Program& made)>& after = nullptr);

}  // namespace ombre::program
