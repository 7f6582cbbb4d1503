// Style sheets of SVG files: which value a property has at an element. Only for builds with pugixml.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/containers/xml_file.h"

namespace ombre::formats {

// Greatest depth of nested elements, uses of other elements included.
inline constexpr int deepest_svg_element = 1000;

// The values that apply to one element, without those that it inherits.
using SvgValues = std::map<std::string_view, std::string_view>;

// The style elements of a file. By CSS 2.1, section 6.4: presentation attributes are weakest; then selectors of types,
// classes and ids, the later of equal ones; then the attribute style; then values that are !important.
class SvgSheet {
 public:
  // Reads the style elements below `root`. Reports selectors that are not read and could change shapes, and throws
  // DesignError.
  SvgSheet(const XmlFile& file, pugi::xml_node root);

  SvgValues values_of(pugi::xml_node node) const;

 private:
  struct Compound {
    std::string type, id;
    std::vector<std::string> classes;
    bool is_child = false;  // the element before must be the parent, not any ancestor
  };
  struct Declaration {
    std::string_view property, value;
    bool is_important = false;
  };
  struct Rule {
    std::vector<Compound> selector;  // the last one is the element itself
    int specificity = 0;
    size_t declarations = 0;  // an index
  };

  void read_sheets(pugi::xml_node node, int depth);
  void read_sheet(pugi::xml_node node, std::string text);
  void add_rule(pugi::xml_node node, std::string_view selectors, std::string_view body);
  static std::optional<Rule> rule_of(std::string_view selector);
  static std::vector<Declaration> declarations_of(std::string_view body);
  static bool changes_shapes(const std::vector<Declaration>& declarations);
  static bool fits(const Compound& compound, pugi::xml_node node);
  static bool fits(const Rule& rule, pugi::xml_node node);
  void append_rules(const std::string& key, pugi::xml_node node, std::vector<size_t>& found) const;

  const XmlFile& file_;
  std::vector<std::unique_ptr<const std::string>> texts_;  // which the declarations refer to
  std::vector<std::vector<Declaration>> declarations_;
  std::vector<Rule> rules_;
  std::map<std::string, std::vector<size_t>, std::less<>> rules_by_key_;  // by "#id", ".class", type or "*"
};

}  // namespace ombre::formats
