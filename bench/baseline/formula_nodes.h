// The nodes that are described by formulas.
#pragma once

#include <string>

#include "node.h"

namespace baseline {

NodePtr function(const std::string& expression, const Box& box, size_t material);
NodePtr grade(const std::vector<std::string>& functions, std::vector<size_t> materials, bool greatest_takes_all,
              NodePtr child);

}  // namespace baseline
