// Writes XML as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace ombre::formats {

inline constexpr std::string_view xml_declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// Escapes text and attributes in double quotes. Characters that XML cannot hold (control characters, invalid UTF-8)
// become '?'.
std::string xml_escaped(std::string_view text);

// Returns ` name="value"`.
std::string xml_attribute(std::string_view name, std::string_view value);
// Appends ` name="value"`, whose value append_float() or append_count() writes.
template <class Number>
void append_xml_attribute(std::string& text, std::string_view name, void (&append)(std::string&, Number),
                          std::type_identity_t<Number> value) {
  text.append(" ").append(name).append("=\"");
  append(text, value);
  text += '"';
}

// Returns "#RRGGBB" for three components, "#RRGGBBAA" for four.
std::string hex_colour(std::span<const uint8_t> parts);

}  // namespace ombre::formats
