// Runs the passes that a design's program goes through on its way to the slicer.
#pragma once

#include <string>
#include <vector>

namespace ombre::compile {

struct PassResult {
  std::string name, sentence;
  program::Program program;  // the result of the pass
  double seconds = 0;
};

// Runs the passes as plan_slice() does for the design's box and stochastic dithering. Ends early, without a message, if
// the design has no box or is too large.
std::vector<PassResult> slicing_passes(const design::Design& design);

// Returns the names of all passes, in their order.
std::vector<std::string> slicing_pass_names();

}  // namespace ombre::compile
