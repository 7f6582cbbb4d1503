// Conversion between JSON text and Data with source positions.
#pragma once

#include <optional>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre {

// Returns nothing and adds a diagnostic with line and column if the text is not JSON or nests deeper than 200 levels.
// Duplicate keys are errors.
std::optional<Data> parse_json(const SourcePtr& source, Diagnostics& diagnostics);

// Returns indented text (two spaces), with short lists on one line. Numbers read back to the same bits. Infinities and
// NaN, which JSON lacks, are written as null.
std::string print_json(const Data& data);
// Returns the text on one line, for event streams and hashes.
std::string print_json_line(const Data& data);

}  // namespace ombre
