// XML as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ombre::formats {

inline constexpr std::string_view xml_declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// For text and for attributes in double quotes. What XML cannot hold (control characters, wrong UTF-8) becomes '?'.
std::string xml_escaped(std::string_view text);

// ` name="value"`
std::string xml_attribute(std::string_view name, std::string_view value);

// "#RRGGBB" of three parts, "#RRGGBBAA" of four.
std::string hex_colour(std::span<const uint8_t> parts);

}  // namespace ombre::formats
