// What becomes of a design's program on its way to the slicer, pass by pass.
#pragma once

#include <string>
#include <vector>

namespace ombre::compile {

struct PassResult {
  std::string name, sentence;
  program::Program program;  // what it made
  double seconds = 0;
};

// As plan_slice() does it for the design's box and stochastic dithering. Ends early, without a word, where the design
// has no box or is too large.
std::vector<PassResult> slicing_passes(const design::Design& design);

// The names of all passes there are, in their order.
std::vector<std::string> slicing_pass_names();

}  // namespace ombre::compile
