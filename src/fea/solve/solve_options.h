// Options of solving systems of equations.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ombre::fea {

// A factorisation that was made or is about to be made.
struct DirectUse {
  double operations = 0, memory_bytes = 0;
  double disk_bytes = 0;  // 0: the factor is in memory
};

struct SolveOptions {
  double tolerance = 1e-8;  // greatest residual, in the norm of the right side
  size_t most_iterations = 20000;
  int threads = 0;                   // 0: all cores
  std::string solver = "multigrid";  // a name of solvers.h
  double memory_bytes = 8e9;         // memory that a factorisation may take
  std::function<void(const DirectUse&)> announce = {};
};

}  // namespace ombre::fea
