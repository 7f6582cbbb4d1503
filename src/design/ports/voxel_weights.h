// Weights of the voxels around one as a parameter.
#pragma once

#include <vector>

#include "design/ports/numbers.h"

namespace ombre::design {

// Weights of the voxels around one, as lists along x of lists along y of lists along z.
struct Kernel {
  Counts3 size{};               // numbers of weights, 1 to 1000 each, if given
  std::vector<double> weights;  // z varies fastest; at most 10^6 finite weights, with a sum >= 0 and not all 0
  bool operator==(const Kernel&) const = default;
};

template <>
struct Port<Kernel> {
  static PortText text(const Domain&) { return {"lists of lists of numbers", "kernels", "ArrayLike"}; }
  static bool read(const Data& data, const Domain& domain, Kernel& value, const Reader& reader);
  static Data write(const Kernel& value, bool for_hash);
};

}  // namespace ombre::design
