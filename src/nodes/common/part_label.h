// The label that names the parts of a design.
#pragma once

#include <string_view>

namespace ombre::nodes {

inline constexpr std::string_view label_name = "part";

}  // namespace ombre::nodes
