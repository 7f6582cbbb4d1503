// A part of a deck: its nodes, elements and sets, and what generates more of them.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/results/deck.h"

namespace ombre::formats {

// The thickness of the shells of a set.
struct ShellSection {
  std::string set;          // in lower case
  double thickness_mm = 0;  // of all layers
  double offset = 0;        // from the middle of the shells to their nodes, along the normal, in thicknesses
};

class DeckPart {
 public:
  using Set = std::vector<uint64_t>;

  struct Node {
    uint64_t number = 0;
    Vec3 at;
  };
  struct Element {
    uint64_t number = 0;
    size_t first = 0;  // of its nodes
    ElementKind kind = ElementKind::brick8;
    DeckLine line;
    bool is_shell = false;  // its kind is the solid that it becomes, which has more nodes

    size_t node_count() const { return is_shell ? shell_node_count(kind) : formats::node_count(kind); }
  };

  // Returns the number of nodes of a shell that becomes a solid element.
  static size_t shell_node_count(ElementKind kind) {
    return kind == ElementKind::brick20 ? 8 : formats::node_count(kind) / 2;
  }

  // Both stand in the order in which they were added.
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Element>& elements() const { return elements_; }
  // Returns the numbers of the element's nodes, which need not be there.
  std::span<const uint64_t> nodes_of(const Element& element) const;
  // Returns the place of a node in nodes(). Reports an error at the element's line if the node is not there.
  uint32_t place_of(const Element& element, uint64_t node) const;
  bool has_element(uint64_t number) const { return element_places_.contains(number); }

  const std::vector<ShellSection>& shell_sections() const { return shell_sections_; }
  ShellSection& add_shell_section(ShellSection section) { return shell_sections_.emplace_back(std::move(section)); }
  // Returns the members of a set in their order, each once; none if there is no such set.
  Set element_set(std::string_view name) const;

  // Returns the sets with how many members they have, in the order of their names.
  std::vector<ResultSet> sets() const;
  // Returns how many members the set of that name has, or 1 for the number of a node or element.
  uint64_t size_of(ResultSet::Of of, std::string_view name) const;

  // Both functions report an error at the line if an element has the number already, or a node at another place. The
  // name of the set may be empty.
  void add_node(const DeckLine& line, uint64_t number, Vec3 at, const std::string& set);
  void add_element(const DeckLine& line, uint64_t number, ElementKind kind, std::span<const uint64_t> nodes,
                   const std::string& set, bool is_shell = false);

  // Each takes a line of data below the keyword.
  void add_to_node_set(const Keyword& nset, const DeckLine& line);
  void add_to_element_set(const Keyword& elset, const DeckLine& line);
  void generate_nodes(const Keyword& ngen, const DeckLine& line);
  void fill_nodes(const Keyword& nfill, const DeckLine& line);
  void generate_elements(const Keyword& elgen, const DeckLine& line);

  void copy_nodes(const Keyword& ncopy, const Affine& move);
  void copy_elements(const Keyword& elcopy);

 private:
  using Sets = std::map<std::string, Set, std::less<>>;

  // Returns the set, or the one node whose number the name is. Sets are sorted unless they say that they are not.
  Set node_set(const DeckLine& line, std::string_view name) const;
  // Reports an error at the line if the part generates too many nodes and elements.
  void count_generated(const DeckLine& line, int64_t count);
  Vec3 node_at(const DeckLine& line, uint64_t number) const;
  Element element_at(const DeckLine& line, uint64_t number) const;
  void copy_element(const DeckLine& line, const Element& master, int64_t by, int64_t nodes_by, const std::string& set);

  std::vector<Node> nodes_;
  std::vector<Element> elements_;
  std::vector<uint64_t> element_nodes_;
  std::unordered_map<uint64_t, uint32_t> node_places_, element_places_;
  Sets node_sets_, element_sets_;
  std::vector<ShellSection> shell_sections_;
  int64_t generated_ = 0;
  std::set<std::string> unsorted_sets_;
};

}  // namespace ombre::formats
