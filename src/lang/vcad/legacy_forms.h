// Spellings and positional forms of older .vcad files, brought to names and parameters of the registry.
#pragma once

#include <string>
#include <string_view>

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// The registry's name of a node under any of its spellings.
std::string_view node_name(std::string_view spelling);

// Arguments with their names filled in or changed: numbers gathered to vectors, short names spelt out.
// What is no legacy form is left as it is.
std::vector<Argument> modern_arguments(const design::NodeType& type, std::vector<Argument> arguments);

}  // namespace ombre::lang
