// Reads style sheets of SVG files.
#include "formats/drawings/svg_style.h"

#ifdef OMBRE_3MF

#include <algorithm>
#include <array>
#include <memory>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

// The properties that decide about shapes.
constexpr std::array<std::string_view, 29> properties{"display",
                                                      "visibility",
                                                      "fill",
                                                      "fill-opacity",
                                                      "fill-rule",
                                                      "stroke",
                                                      "stroke-opacity",
                                                      "stroke-width",
                                                      "stroke-linecap",
                                                      "stroke-linejoin",
                                                      "stroke-miterlimit",
                                                      "stroke-dasharray",
                                                      "clip-path",
                                                      "clip-rule",
                                                      "mask",
                                                      "overflow",
                                                      "transform",
                                                      "transform-origin",
                                                      "x",
                                                      "y",
                                                      "width",
                                                      "height",
                                                      "cx",
                                                      "cy",
                                                      "r",
                                                      "rx",
                                                      "ry",
                                                      "d",
                                                      "vector-effect"};

// Returns the property's own name, which outlives the text, or null.
const std::string_view* property_of(std::string_view name) {
  const auto found = std::ranges::find(properties, name);
  return found == properties.end() ? nullptr : &*found;
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 128;
}

std::string take_name(std::string_view& text) {
  size_t size = 0;
  while (size < text.size() && is_name_character(text[size])) ++size;
  std::string name(text.substr(0, size));
  text.remove_prefix(size);
  return name;
}

std::string without_comments(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const size_t begin = text.find("/*");
    result += text.substr(0, begin);
    if (begin == std::string_view::npos) break;
    const size_t end = text.find("*/", begin + 2);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
    result += ' ';
  }
  return result;
}

// Selectors of a pointer's state never fit a still drawing.
bool is_of_pointer(std::string_view selector) {
  return std::ranges::any_of(std::array<std::string_view, 4>{":hover", ":active", ":focus", "::"},
                             [&](auto state) { return selector.find(state) != std::string_view::npos; });
}

// Removes the text up to the brace that closes the one just read, and returns it.
std::string_view take_body(std::string_view& text) {
  int depth = 1;
  size_t n = 0;
  for (; n < text.size() && depth > 0; ++n) depth += text[n] == '{' ? 1 : text[n] == '}' ? -1 : 0;
  const std::string_view body = text.substr(0, depth == 0 ? n - 1 : n);
  text.remove_prefix(n);
  return body;
}

}  // namespace

SvgSheet::SvgSheet(const XmlFile& file, pugi::xml_node root) : file_(file) { read_sheets(root, 0); }

void SvgSheet::read_sheets(pugi::xml_node node, int depth) {
  if (depth > deepest_svg_element) file_.fail_at(node, "elements lie more than 1000 deep within each other");
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    if (local_name(child) != "style") {
      read_sheets(child, depth + 1);
      continue;
    }
    std::string text = child.text().get();
    for (const pugi::xml_node part : child.children())
      if (part.type() == pugi::node_cdata) text += std::string(part.value()) == text ? "" : part.value();
    read_sheet(child, without_comments(text));
  }
}

void SvgSheet::read_sheet(pugi::xml_node node, std::string all) {
  texts_.push_back(std::make_unique<const std::string>(std::move(all)));
  std::string_view text = *texts_.back();
  while (!(text = trim(text)).empty()) {
    if (text.starts_with("<!--") || text.starts_with("-->")) {
      text.remove_prefix(text[0] == '<' ? 4 : 3);
      continue;
    }
    const size_t open = text.find_first_of("{;");
    if (text[0] == '@') {
      const std::string_view rule = text.substr(0, open);
      if (rule.starts_with("@import") || rule.starts_with("@media"))
        file_.fail_at(node, "the style rule " + quoted(trim(rule)) + " is not read",
                      "let the program that made the file write its styles into the elements");
      const bool has_body = open != std::string_view::npos && text[open] == '{';
      text.remove_prefix(std::min(text.size(), open == std::string_view::npos ? text.size() : open + 1));
      if (has_body) take_body(text);
      continue;
    }
    if (open == std::string_view::npos || text[open] != '{') return;
    const std::string_view selectors = text.substr(0, open);
    text.remove_prefix(open + 1);
    add_rule(node, selectors, take_body(text));
  }
}

void SvgSheet::add_rule(pugi::xml_node node, std::string_view selectors, std::string_view body) {
  std::vector<Declaration> declarations = declarations_of(body);
  if (declarations.empty()) return;
  declarations_.push_back(std::move(declarations));
  for (const std::string_view selector : split(selectors, ',')) {
    if (is_of_pointer(selector)) continue;
    auto rule = rule_of(trim(selector));
    if (!rule && !changes_shapes(declarations_.back())) continue;
    if (!rule)
      file_.fail_at(node, "the style selector " + quoted(trim(selector)) + " is not read, and it could change shapes",
                    "use types, classes, ids and their combinations by blanks and >");
    rule->declarations = declarations_.size() - 1;
    const Compound& last = rule->selector.back();
    const std::string key = !last.id.empty()        ? "#" + last.id
                            : !last.classes.empty() ? "." + last.classes[0]
                            : !last.type.empty()    ? last.type
                                                    : "*";
    rules_by_key_[key].push_back(rules_.size());
    rules_.push_back(std::move(*rule));
  }
}

// A colour decides about shapes only if it is none.
bool SvgSheet::changes_shapes(const std::vector<Declaration>& declarations) {
  return std::ranges::any_of(declarations, [](const Declaration& one) {
    return (one.property != "fill" && one.property != "stroke") || one.value == "none";
  });
}

std::optional<SvgSheet::Rule> SvgSheet::rule_of(std::string_view selector) {
  constexpr int of_id = 1'000'000, of_class = 1000;
  Rule rule;
  bool is_child = false;
  while (!(selector = trim(selector)).empty()) {
    if (selector[0] == '>') {
      if (is_child || rule.selector.empty()) return std::nullopt;
      is_child = true;
      selector.remove_prefix(1);
      continue;
    }
    Compound compound;
    compound.is_child = is_child;
    is_child = false;
    const size_t before = selector.size();
    if (selector[0] == '*')
      selector.remove_prefix(1);
    else if (!(compound.type = take_name(selector)).empty())
      ++rule.specificity;
    while (!selector.empty() && (selector[0] == '.' || selector[0] == '#')) {
      const bool is_id = selector[0] == '#';
      selector.remove_prefix(1);
      const std::string name = take_name(selector);
      if (name.empty()) return std::nullopt;
      if (is_id)
        compound.id = name;
      else
        compound.classes.push_back(name);
      rule.specificity += is_id ? of_id : of_class;
    }
    constexpr std::string_view ends = " \t\r\n>";
    if (selector.size() == before || (!selector.empty() && ends.find(selector[0]) == std::string_view::npos))
      return std::nullopt;
    rule.selector.push_back(std::move(compound));
  }
  if (rule.selector.empty() || is_child) return std::nullopt;
  return rule;
}

std::vector<SvgSheet::Declaration> SvgSheet::declarations_of(std::string_view body) {
  std::vector<Declaration> list;
  while (!body.empty()) {
    const std::string_view one = body.substr(0, body.find(';'));
    body.remove_prefix(std::min(body.size(), one.size() + 1));
    const size_t colon = one.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view* property = property_of(trim(one.substr(0, colon)));
    if (!property) continue;
    std::string_view value = trim(one.substr(colon + 1));
    const size_t mark = value.rfind('!');
    const bool is_important = mark != std::string_view::npos && trim(value.substr(mark + 1)) == "important";
    if (is_important) value = trim(value.substr(0, mark));
    list.push_back({*property, value, is_important});
  }
  return list;
}

bool SvgSheet::fits(const Compound& compound, pugi::xml_node node) {
  if (!compound.type.empty() && compound.type != local_name(node)) return false;
  if (!compound.id.empty() && std::string_view(node.attribute("id").value()) != compound.id) return false;
  return std::ranges::all_of(compound.classes, [&](const std::string& wanted) {
    std::string_view list = node.attribute("class").value();
    for (std::string_view word = next_word(list); !word.empty(); word = next_word(list))
      if (word == wanted) return true;
    return false;
  });
}

// A descendant takes its nearest fitting ancestor, which is the best choice unless children follow it.
bool SvgSheet::fits(const Rule& rule, pugi::xml_node node) {
  if (!fits(rule.selector.back(), node)) return false;
  bool is_child = rule.selector.back().is_child;
  for (size_t n = rule.selector.size() - 1; n-- > 0;) {
    node = node.parent();
    if (!is_child)
      while (node && !fits(rule.selector[n], node)) node = node.parent();
    if (!node || !fits(rule.selector[n], node)) return false;
    is_child = rule.selector[n].is_child;
  }
  return true;
}

void SvgSheet::append_rules(const std::string& key, pugi::xml_node node, std::vector<size_t>& found) const {
  const auto rules = rules_by_key_.find(key);
  if (rules == rules_by_key_.end()) return;
  for (const size_t rule : rules->second)
    if (fits(rules_[rule], node)) found.push_back(rule);
}

SvgValues SvgSheet::values_of(pugi::xml_node node) const {
  SvgValues values;
  for (const pugi::xml_attribute& attribute : node.attributes())
    if (const std::string_view* property = property_of(attribute.name())) values[*property] = trim(attribute.value());
  std::vector<size_t> found;
  if (!rules_.empty()) {
    append_rules("*", node, found);
    append_rules(std::string(local_name(node)), node, found);
    append_rules("#" + std::string(node.attribute("id").value()), node, found);
    std::string_view list = node.attribute("class").value();
    for (std::string_view word = next_word(list); !word.empty(); word = next_word(list))
      append_rules("." + std::string(word), node, found);
    std::ranges::sort(found, {}, [&](size_t n) { return std::pair(rules_[n].specificity, n); });
  }
  const auto own = declarations_of(node.attribute("style").value());
  for (const bool is_important : {false, true}) {
    const auto apply = [&](const std::vector<Declaration>& list) {
      for (const Declaration& one : list)
        if (one.is_important == is_important) values[one.property] = one.value;
    };
    for (const size_t rule : found) apply(declarations_[rules_[rule].declarations]);
    apply(own);
  }
  return values;
}

}  // namespace ombre::formats

#endif
