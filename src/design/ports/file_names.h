// Files, fonts, tables and the variables of scripts as parameters.
#pragma once

#include <string>
#include <vector>

#include "base/system/hash.h"
#include "design/ports/port.h"

namespace ombre::design {

struct FilePath {
  std::string path;
  Hash content;  // hash of the file's content, set when it is loaded
  bool operator==(const FilePath&) const = default;
};

// A font, by its name or the path of its file.
struct FontName {
  std::string name;
  Hash content;  // hash of the font that was found
  bool operator==(const FontName&) const = default;
};

// Rows with the same number of values each, or the file that holds them.
struct NumberTable {
  std::vector<std::vector<double>> rows;
  FilePath file;  // empty if the rows were given directly
  bool operator==(const NumberTable&) const = default;
};

// Values for the variables of a script in another language, by name: numbers, texts, truth values, and lists of them.
struct ScriptVariables {
  DataMembers values;
  bool operator==(const ScriptVariables&) const = default;
};

template <>
struct Port<FilePath> {
  static PortText text(const Domain&) { return {"file", "files", "Path", "file"}; }
  static bool read(const Data& data, const Domain& domain, FilePath& value, const Reader& reader);
  static Data write(const FilePath& value, bool for_hash);
};

template <>
struct Port<FontName> {
  static PortText text(const Domain&) { return {"font", "fonts", "Path"}; }
  static bool read(const Data& data, const Domain& domain, FontName& value, const Reader& reader);
  static Data write(const FontName& value, bool for_hash);
};

template <>
struct Port<NumberTable> {
  static PortText text(const Domain&) {
    return {"rows of numbers, or a CSV file", "tables", "Union[Path, Sequence[Sequence[float]]]"};
  }
  static bool read(const Data& data, const Domain& domain, NumberTable& value, const Reader& reader);
  static Data write(const NumberTable& value, bool for_hash);
};

template <>
struct Port<ScriptVariables> {
  static PortText text(const Domain&) { return {"values by name", "lists of values by name", "Mapping[str, Any]"}; }
  static bool read(const Data& data, const Domain& domain, ScriptVariables& value, const Reader& reader);
  static Data write(const ScriptVariables& value, bool for_hash);
  static constexpr bool takes_other_names = true;
};

}  // namespace ombre::design
