// Compares arguments of operators with what their declarations allow.
#pragma once

#include <string>

#include "lang/engine/value.h"
#include "lang/syntax/declaration.h"

namespace ombre::lang {

// Returns nothing if the parameter may have this value, else what was expected and found: "expected a number from 1 to
// 20 (mm), found 25".
std::string mismatch_of(const DeclaredParameter& parameter, const Value& value);

// Returns whether a text that is given for the parameter is the name of a material.
bool names_material(const DeclaredParameter& parameter);

}  // namespace ombre::lang
