// Converts spellings and positional forms of older .vcad files to names and parameters of the registry.
#pragma once

#include <string>
#include <string_view>

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Returns the registry's name of a node for any of its spellings.
std::string_view node_name(std::string_view spelling);

// Returns arguments in the current form: names are filled in, numbers are joined to vectors, and short names are
// replaced. Other arguments stay as they are.
std::vector<Argument> modern_arguments(const design::NodeType& type, std::vector<Argument> arguments);

}  // namespace ombre::lang
