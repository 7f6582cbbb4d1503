// Stable codes of errors, for programs that read messages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ombre {

// Codes, in the order of the table in code.cpp, which says what each means.
enum class Code : uint8_t {
  design,
  syntax,
  script,
  assertion,
  expression,
  design_file,
  materials_file,
  printer_file,
  study,
  study_value,
  unknown_node,
  unknown_parameter,
  unknown_material,
  unknown_attribute,
  unknown_output,
  unknown_part,
  unknown_object,
  unknown_variable,
  unknown_function,
  unknown_printer,
  unknown_key,
  unknown_font,
  parameter_missing,
  parameter_type,
  parameter_range,
  parameters,
  inputs,
  twice,
  limit,
  unbounded,
  nothing_inside,
  outside_box,
  distance_unknown,
  file_missing,
  file_kind,
  file_content,
  surface_open,
  surface_crosses,
  option,
  exists,
  other_job,
  unfinished,
  too_large,
  memory,
  disk_space,
  cannot_read,
  cannot_write,
  library_missing,
  not_solved,
  not_meshed,
  other_program,
  machine,
};

struct CodeInfo {
  Code code;
  std::string_view name;      // the code's name: "unknown-node"
  std::string_view sentence;  // the meaning
  std::string_view values;    // comma-separated names of the values of a message with this code: "node, similar"
};

std::span<const CodeInfo> codes();
// Returns the name of the code, for example "unknown-node".
std::string_view name_of(Code code);

// The values of a message by name: {"node", "sphre"}.
using CodeValues = std::vector<std::pair<std::string, std::string>>;

}  // namespace ombre
