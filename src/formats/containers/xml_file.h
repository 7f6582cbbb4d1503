// XML by pugixml, with messages that point at the element that is wrong. Only for files that are built with it.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"

namespace ombre::formats {

// The name without the prefix of its namespace.
std::string_view local_name(const char* name);
inline std::string_view local_name(pugi::xml_node node) { return local_name(node.name()); }

// Takes the next word off a list of them; empty at the end.
std::string_view next_word(std::string_view& text);

// Entities of a file's own stay as they are written, nothing else is read. Failures are reported and end the reading
// by DesignError.
class XmlFile {
 public:
  // For the tree; a copy of the text comes to it.
  static constexpr uint64_t most_tree_bytes = uint64_t{4} << 30;

  // `name` is for messages. The text must live as long.
  XmlFile(std::string name, std::string_view text, Diagnostics& diagnostics);

  // Its outermost element, which must have that name.
  pugi::xml_node root(std::string_view wanted) const;

  // An attribute by its local name; nothing if it is missing.
  std::optional<std::string_view> attribute(pugi::xml_node node, std::string_view wanted) const;
  // One that must be there.
  std::string_view required(pugi::xml_node node, std::string_view wanted) const;

  // What `text` within `node` says; `what` is for messages.
  double number(pugi::xml_node node, std::string_view text, std::string_view what) const;
  // One that fits a vertex: finite, within greatest_coordinate.
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
