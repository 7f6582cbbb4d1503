// JSON text <-> Data, with the place of every value.
#pragma once

#include <optional>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre {

// Nothing, and a diagnostic with line and column, when the text is not JSON or nests deeper than 200.
// Duplicate keys are errors.
std::optional<Data> parse_json(const SourcePtr& source, Diagnostics& diagnostics);

// Pretty-printed with two spaces, short lists on one line; numbers read back to the same bits.
// Infinities and NaN, which JSON lacks, are written as null.
std::string print_json(const Data& data);
// On one line, for event streams and hashing.
std::string print_json_line(const Data& data);

}  // namespace ombre
