// Parameters of a script: its top-level variables with plain values, and what comments say about them. The form is that
// of OpenSCAD's customizer: "/* [Section] */" before, "// description" above, "// [0:10]" behind.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::lang::openscad {

struct Parameter {
  enum class Kind : uint8_t { number, boolean, text, vector, choice };

  std::string name, description;
  std::string section;  // empty: none was named; "Hidden" is for parameters that users should not see
  Kind kind = Kind::number;
  Data value;                                         // the script's own, and where it stands
  std::optional<double> least, step, most;            // of numbers, of each number of a vector
  std::optional<size_t> longest;                      // characters of a text
  std::vector<std::pair<Data, std::string>> choices;  // values and what to call them
};

// In the order of the script. Parameters end at the first "{", where modules begin.
std::vector<Parameter> parameters_of(const SourcePtr& source);

// "name", "kind" and so on, for programs.
Data to_data(const Parameter& parameter);

// Definitions (`name=value`, as `-D` takes them) of a set in a file of parameter sets:
// {"parameterSets": {"small": {"size": "10", ...}}}. Values of texts stand there without quotes, so the script's
// parameters say how each is read; names that the script does not have are warnings. Nothing, and a diagnostic, where
// there is no such set.
std::optional<std::vector<std::string>> parameter_set(const SourcePtr& file, const std::string& name,
                                                      const std::vector<Parameter>& parameters,
                                                      Diagnostics& diagnostics);

}  // namespace ombre::lang::openscad
