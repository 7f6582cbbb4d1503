// What users of OpenSCAD write first and .vcad spells otherwise: what to write here.
#pragma once

#include <string>
#include <string_view>

#include "design/registry.h"
#include "lang/vocabulary.h"

namespace ombre::lang {

// For a module of OpenSCAD that is no node; empty for other names.
std::string openscad_module_hint(std::string_view name);

// For an argument as OpenSCAD has it and the node does not take it; empty for others.
std::string openscad_argument_hint(const design::NodeType& type, const Argument& argument);

}  // namespace ombre::lang
