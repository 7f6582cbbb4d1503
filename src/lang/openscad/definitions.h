// Values of another program as assignments of a script.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/text/data.h"

namespace ombre::lang::openscad {

// `name=value`, as `-D` takes it. Nothing for a value that scripts do not have, such as a solid, and for what is no
// name of a variable.
std::optional<std::string> definition_of(const std::string& name, const Data& value);

// Whether the name stands in the text outside of comments and strings.
bool mentions(const SourcePtr& script, std::string_view name);

}  // namespace ombre::lang::openscad
