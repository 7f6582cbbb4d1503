#include "design/ports/file_names.h"

#include "design/ports/numbers.h"

namespace ombre::design {

bool Port<FilePath>::read(const Data& data, const Domain&, FilePath& value, const Reader& reader) {
  if (!data.string() || data.string()->empty()) return reader.fail(data, "the path of a file");
  value.path = *data.string();
  return true;
}

Data Port<FilePath>::write(const FilePath& value, bool for_hash) {
  return Data(for_hash ? value.content.hex() : value.path);
}

bool Port<FontName>::read(const Data& data, const Domain&, FontName& value, const Reader& reader) {
  if (!data.string() || data.string()->empty()) return reader.fail(data, "the name of a font, or the path of its file");
  value.name = *data.string();
  return true;
}

Data Port<FontName>::write(const FontName& value, bool for_hash) {
  return Data(for_hash ? value.content.hex() : value.name);
}

namespace {

bool read_row(const Data& data, std::vector<double>& row, const Reader& reader) {
  if (!data.list()) return reader.fail(data, "rows of numbers", "write for example [[0, 1], [10, 5]]");
  for (const Data& element : *data.list()) {
    row.push_back(0);
    if (!design::read(element, any(), row.back(), reader)) return false;
  }
  return true;
}

}  // namespace

bool Port<NumberTable>::read(const Data& data, const Domain& domain, NumberTable& value, const Reader& reader) {
  value = {};
  if (data.string()) return design::read(data, domain, value.file, reader);
  if (!data.list()) return reader.fail(data, "rows of numbers, or the path of a CSV file");
  for (const Data& element : *data.list()) {
    value.rows.emplace_back();
    if (!read_row(element, value.rows.back(), reader)) return false;
  }
  return true;
}

Data Port<NumberTable>::write(const NumberTable& value, bool for_hash) {
  if (!value.file.path.empty()) return design::write(value.file, for_hash);
  DataList list;
  for (const auto& row : value.rows) {
    DataList numbers;
    for (const double number : row) numbers.emplace_back(number);
    list.emplace_back(std::move(numbers));
  }
  return Data(std::move(list));
}

bool Port<ScriptVariables>::read(const Data& data, const Domain&, ScriptVariables& value, const Reader& reader) {
  value = {};
  if (data.is_null()) return true;
  if (!data.members()) return reader.fail(data, "values by name", "write for example {\"width\": 20}");
  value.values = *data.members();
  return true;
}

Data Port<ScriptVariables>::write(const ScriptVariables& value, bool) { return Data(value.values); }

}  // namespace ombre::design
