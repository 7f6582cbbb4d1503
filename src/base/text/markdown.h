// Tables of Markdown.
#pragma once

#include <initializer_list>
#include <string>

namespace ombre {

// Returns a row of a table. A "|" in a cell is no border, and a line's end becomes a space.
std::string table_row(std::initializer_list<std::string> cells);

}  // namespace ombre
