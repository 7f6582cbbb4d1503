// The parameters of a script: its top-level variables with plain values, described by comments in the form of
// OpenSCAD's customizer: "/* [Section] */" before, "// description" above, "// [0:10]" after.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "lang/syntax/annotation.h"

namespace ombre::lang::openscad {

struct Parameter : Allowed {
  enum class Kind : uint8_t { number, boolean, text, vector, choice };

  std::string name, description;
  std::string section;  // empty if there is none; "Hidden" marks parameters that users should not see
  Kind kind = Kind::number;
  Data value;                     // the script's value, with its position
  std::optional<size_t> longest;  // greatest number of characters of a text
};

// Returns the parameters in the order of the script. They end at the first "{", where modules begin.
std::vector<Parameter> parameters_of(const SourcePtr& source);

// Returns the members "name", "kind" and so on, for programs.
Data to_data(const Parameter& parameter);

// Returns definitions (`name=value`, as for `-D`) from a named set in a file of parameter sets: {"parameterSets":
// {"small": {"size": "10", ...}}}. Texts have no quotes in the file, so the script's parameters determine how values
// are read. Names that the script does not have give warnings. Returns nothing and adds a diagnostic if there is no
// such set.
std::optional<std::vector<std::string>> parameter_set(const SourcePtr& file, const std::string& name,
                                                      const std::vector<Parameter>& parameters,
                                                      Diagnostics& diagnostics);

}  // namespace ombre::lang::openscad
