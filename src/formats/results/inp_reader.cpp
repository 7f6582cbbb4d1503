// Reads meshes of Abaqus and CalculiX decks (.inp): nodes and solid elements; everything else is ignored.
#include <algorithm>
#include <array>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

// Returns the number of nodes of a solid element type such as "C3D10M" or "DC3D4", or null for other types. Solid types
// have one or two digits.
std::optional<size_t> solid_nodes(std::string_view type) {
  const size_t at = type.find("c3d");
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view digits = type.substr(at + 3);
  digits = digits.substr(0, digits.find_first_not_of("0123456789"));
  const auto count = digits.size() <= 2 ? parse_number(digits) : std::nullopt;
  return count ? std::optional(static_cast<size_t>(*count)) : std::nullopt;
}

std::optional<ElementKind> kind_of_nodes(size_t count) {
  for (const ElementKind kind :
       {ElementKind::tetrahedron4, ElementKind::tetrahedron10, ElementKind::brick8, ElementKind::brick20})
    if (node_count(kind) == count) return kind;
  return std::nullopt;
}

class InpReader {
 public:
  InpReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : name_(name), bytes_(bytes), diagnostics_(diagnostics), scanner_(name, bytes, diagnostics) {}

  NumberedResults run() {
    for (size_t begin = 0; begin < bytes_.size();) {
      const size_t end = std::min(bytes_.find('\n', begin), bytes_.size());
      line_ = trim(bytes_.substr(begin, end - begin));
      begin_ = begin;
      end_ = end;
      begin = end + 1;
      if (line_.empty() || line_.starts_with("**")) continue;
      if (line_.starts_with('*'))
        begin_keyword();
      else if (block_ == Block::nodes)
        add_node();
      else if (block_ == Block::elements)
        add_element_numbers();
      else if (block_ == Block::flat)
        ++flat_;
    }
    finish_element();
    if (flat_ > 0)
      diagnostics_.warning({make_source(name_, ""), 0, 0},
                           format_count(flat_) + " lines of elements that are no solids are left out");
    return std::move(result_);
  }

 private:
  enum class Block : uint8_t { other, nodes, elements, flat };

  [[noreturn]] void fail_line(const std::string& message, const std::string& hint = "") const {
    scanner_.fail_at(begin_, end_, message, hint);
  }

  void begin_keyword() {
    finish_element();
    const std::vector<std::string> words = split(to_lower(line_), ',');
    const std::string keyword(trim(words.front()));
    block_ = keyword == "*node" ? Block::nodes : keyword == "*element" ? Block::elements : Block::other;
    if (keyword == "*include")
      fail_line("the deck includes another file, which is not read", "save the mesh in one file");
    if (block_ != Block::elements) return;
    std::string type;
    for (const std::string& word : words)
      if (const size_t equals = word.find('='); equals != std::string::npos && trim(word.substr(0, equals)) == "type")
        type = trim(word.substr(equals + 1));
    const auto nodes = solid_nodes(type);
    if (!nodes) {
      block_ = Block::flat;
      return;
    }
    const auto kind = kind_of_nodes(*nodes);
    if (!kind)
      fail_line("elements of the type " + formats::quoted(type) + " are not read",
                "read are C3D4, C3D10, C3D8 and C3D20");
    kind_ = *kind;
  }

  std::vector<double> numbers() const {
    std::vector<double> list;
    for (const std::string& word : split(std::string(line_), ',')) {
      const std::string_view text = trim(word);
      if (text.empty()) continue;
      const auto value = parse_number(text);
      if (!value) fail_line("expected a number, found " + formats::quoted(text));
      list.push_back(*value);
    }
    return list;
  }

  uint64_t id_of(double number) const {
    if (number >= 1 && number < 1e15 && number == static_cast<double>(static_cast<uint64_t>(number)))
      return static_cast<uint64_t>(number);
    fail_line("expected the number of a node or element, found " + format_number(number));
  }

  void add_node() {
    const std::vector<double> list = numbers();
    if (list.size() < 3) fail_line("expected the number of a node and its coordinates");
    const Vec3 point{list[1], list[2], list.size() > 3 ? list[3] : 0};
    if (!result_.add_node(id_of(list[0]), point)) fail_line("node " + format_number(list[0]) + " comes twice");
  }

  void add_element_numbers() {
    for (const double number : numbers()) element_.push_back(id_of(number));
    if (element_.size() > node_count(kind_)) finish_element();
  }

  void finish_element() {
    if (element_.empty()) return;
    if (element_.size() != node_count(kind_) + 1)
      fail_line("element " + std::to_string(element_[0]) + " has " + std::to_string(element_.size() - 1) +
                " nodes; its type has " + std::to_string(node_count(kind_)));
    const std::string wrong = result_.add_element(kind_, element_[0], {element_.data() + 1, element_.size() - 1});
    if (!wrong.empty()) fail_line(wrong);
    element_.clear();
  }

  const std::string& name_;
  std::string_view bytes_, line_;
  Diagnostics& diagnostics_;
  TextScanner scanner_;
  size_t begin_ = 0, end_ = 0;
  Block block_ = Block::other;
  ElementKind kind_ = ElementKind::brick8;
  std::vector<uint64_t> element_;  // number of the element, followed by those of its nodes
  NumberedResults result_;
  uint64_t flat_ = 0;
};

}  // namespace

bool NumberedResults::add_node(uint64_t number, Vec3 point) {
  const auto place = static_cast<uint32_t>(results.points.size());
  results.points.push_back(point);
  return node_places.try_emplace(number, place).second;
}

std::string NumberedResults::add_element(ElementKind kind, uint64_t number, std::span<const uint64_t> nodes) {
  std::array<uint32_t, 20> places{};
  for (size_t n = 0; n < nodes.size(); ++n) {
    const auto found = node_places.find(nodes[n]);
    if (found == node_places.end())
      return "element " + std::to_string(number) + " names node " + std::to_string(nodes[n]) + ", which is not there";
    places[n] = found->second;
  }
  if (!element_places.try_emplace(number, static_cast<uint32_t>(results.kinds.size())).second)
    return "element " + std::to_string(number) + " comes twice";
  results.add_element(kind, places.data());
  return "";
}

NumberedResults read_inp(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return InpReader(name, bytes, diagnostics).run();
}

}  // namespace ombre::formats
