// Reads XML by pugixml; messages point at the invalid element. Only for builds with pugixml.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"

namespace ombre::formats {

// Returns the name without its namespace prefix.
std::string_view local_name(const char* name);
inline std::string_view local_name(pugi::xml_node node) { return local_name(node.name()); }

// Removes the next word from a list and returns it; empty at the end.
std::string_view next_word(std::string_view& text);

// An XML document. Entities defined by the file stay unexpanded, and nothing else is loaded. Errors are reported, and
// DesignError is thrown.
class XmlFile {
 public:
  // Limit on the tree; a copy of the text is needed in addition.
  static constexpr uint64_t most_tree_bytes = uint64_t{4} << 30;

  // Parses a text, which must outlive this object; `name` is used in messages.
  XmlFile(std::string name, std::string_view text, Diagnostics& diagnostics);

  // Returns the root element, which must have that name.
  pugi::xml_node root(std::string_view wanted) const;

  // Returns an attribute by its local name, or null.
  std::optional<std::string_view> attribute(pugi::xml_node node, std::string_view wanted) const;
  // Returns an attribute that must exist.
  std::string_view required(pugi::xml_node node, std::string_view wanted) const;

  // Parses `text` from `node`; `what` is used in messages.
  double number(pugi::xml_node node, std::string_view text, std::string_view what) const;
  // Parses a coordinate, which must be finite and within greatest_coordinate.
  double coordinate(pugi::xml_node node, std::string_view text, std::string_view what) const;
  uint64_t count(pugi::xml_node node, std::string_view text, std::string_view what) const;

  [[noreturn]] void fail_at(pugi::xml_node node, const std::string& message, const std::string& hint = "") const;
  Diagnostics& diagnostics() const { return diagnostics_; }
  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }

 private:
  [[noreturn]] void fail_at(size_t begin, size_t end, const std::string& message, const std::string& hint) const;
  void check_size() const;

  std::string name_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  pugi::xml_document tree_;
};

}  // namespace ombre::formats
