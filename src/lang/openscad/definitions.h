// Values of another program as assignments in a script.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/text/data.h"

namespace ombre::lang::openscad {

// Returns `name=value`, as for `-D`. Returns nothing for a value that scripts do not have, such as a solid, and for an
// invalid name.
std::optional<std::string> definition_of(const std::string& name, const Data& value);

// True if the name occurs in the text outside comments and strings.
bool mentions(const SourcePtr& script, std::string_view name);

}  // namespace ombre::lang::openscad
