// Hints for users of OpenSCAD whose habits differ from .vcad.
#pragma once

#include <string>
#include <string_view>

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Returns a hint for a module of OpenSCAD that is not a node; empty for other names.
std::string openscad_module_hint(std::string_view name);

// Returns a hint for a parameter of OpenSCAD that the node does not have; empty for others.
std::string openscad_argument_hint(const design::NodeType& type, std::string_view name);

// True for a call in OpenSCAD's form: cube([30, 20, 10]).
bool is_block_of_openscad(std::string_view node, std::string_view parameter, const Data& value);

}  // namespace ombre::lang
