#include "formats/results/deck_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

constexpr int64_t most_generated = 5'000'000;  // nodes and elements of a part

// Returns a whole number of a field, or `otherwise` if the field is missing or empty.
int64_t whole_field(const DeckLine& line, const std::vector<std::string_view>& fields, size_t n, int64_t otherwise) {
  if (n >= fields.size() || fields[n].empty()) return otherwise;
  const auto number = parse_number(fields[n]);
  if (!number || *number != std::floor(*number) || std::abs(*number) > 1e15)
    line.fail("expected a whole number, found " + formats::quoted(fields[n]));
  return static_cast<int64_t>(*number);
}

uint64_t number_field(const DeckLine& line, const std::vector<std::string_view>& fields, size_t n) {
  return deck_number(line, static_cast<double>(whole_field(line, fields, n, 0)));
}

int64_t whole_parameter(const Keyword& keyword, std::string_view name, int64_t otherwise) {
  if (!keyword.has(name)) return otherwise;
  const std::string_view text = keyword.value(name);
  return whole_field(keyword.line, {text}, 0, otherwise);
}

// Reports an error if the keyword has parameters that change what it makes and are not read.
void refuse_parameters(const Keyword& keyword, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (keyword.has(name))
      keyword.line.fail(keyword.name + " with " + name + " is not read",
                        "write out the nodes and elements that it makes");
}

// Returns the members in order, each once.
DeckPart::Set sorted(DeckPart::Set set) {
  std::ranges::sort(set);
  set.erase(std::unique(set.begin(), set.end()), set.end());
  return set;
}

// Adds the numbers of the line: a range if the set is generated, else numbers, and names of other sets.
void add_to_set(const Keyword& keyword, const DeckLine& line, std::map<std::string, DeckPart::Set, std::less<>>& sets,
                std::string_view name_parameter) {
  const std::vector<std::string_view> fields = line.fields();
  DeckPart::Set& set = sets[keyword.name_of(name_parameter)];
  if (keyword.has("generate")) {
    const int64_t first = whole_field(line, fields, 0, 0), last = whole_field(line, fields, 1, first);
    const int64_t step = std::max<int64_t>(1, whole_field(line, fields, 2, 1));
    if ((last - first) / step > most_generated) line.fail("the set has too many members");
    for (int64_t n = first; n <= last; n += step) set.push_back(static_cast<uint64_t>(n));
    return;
  }
  for (const std::string_view field : fields) {
    if (const auto number = parse_number(field)) {
      set.push_back(deck_number(line, *number));
    } else if (const auto other = sets.find(to_lower(field)); other != sets.end()) {
      const DeckPart::Set members = other->second;
      set.insert(set.end(), members.begin(), members.end());
    }
  }
}

}  // namespace

std::span<const uint64_t> DeckPart::nodes_of(const Element& element) const {
  return std::span(element_nodes_).subspan(element.first, element.node_count());
}

uint32_t DeckPart::place_of(const Element& element, uint64_t node) const {
  const auto found = node_places_.find(node);
  if (found == node_places_.end())
    element.line.fail("element " + std::to_string(element.number) + " names node " + std::to_string(node) +
                      ", which is not there");
  return found->second;
}

DeckPart::Set DeckPart::element_set(std::string_view name) const {
  const auto found = element_sets_.find(name);
  return found == element_sets_.end() ? Set() : sorted(found->second);
}

std::vector<ResultSet> DeckPart::sets() const {
  std::vector<ResultSet> list;
  for (const auto& [name, members] : node_sets_) list.push_back({name, ResultSet::Of::nodes, sorted(members).size()});
  for (const auto& [name, members] : element_sets_)
    list.push_back({name, ResultSet::Of::elements, sorted(members).size()});
  return list;
}

uint64_t DeckPart::size_of(ResultSet::Of of, std::string_view name) const {
  if (parse_number(name)) return 1;
  const Sets& sets = of == ResultSet::Of::nodes ? node_sets_ : element_sets_;
  const auto found = sets.find(to_lower(name));
  return found == sets.end() ? 0 : sorted(found->second).size();
}

void DeckPart::add_node(const DeckLine& line, uint64_t number, Vec3 at, const std::string& set) {
  const auto [place, is_new] = node_places_.try_emplace(number, static_cast<uint32_t>(nodes_.size()));
  if (is_new)
    nodes_.push_back({number, at});
  else if (!(nodes_[place->second].at == at))
    line.fail("node " + std::to_string(number) + " comes twice, at different places");
  if (!set.empty()) node_sets_[set].push_back(number);
}

void DeckPart::add_element(const DeckLine& line, uint64_t number, ElementKind kind, std::span<const uint64_t> nodes,
                           const std::string& set, bool is_shell) {
  if (!element_places_.try_emplace(number, static_cast<uint32_t>(elements_.size())).second)
    line.fail("element " + std::to_string(number) + " comes twice");
  elements_.push_back({number, element_nodes_.size(), kind, line, is_shell});
  element_nodes_.insert(element_nodes_.end(), nodes.begin(), nodes.end());
  if (!set.empty()) element_sets_[set].push_back(number);
}

void DeckPart::add_to_node_set(const Keyword& nset, const DeckLine& line) {
  if (nset.has("unsorted")) unsorted_sets_.insert(nset.name_of("nset"));
  add_to_set(nset, line, node_sets_, "nset");
}

void DeckPart::add_to_element_set(const Keyword& elset, const DeckLine& line) {
  add_to_set(elset, line, element_sets_, "elset");
}

void DeckPart::count_generated(const DeckLine& line, int64_t count) {
  generated_ += count;
  if (generated_ > most_generated)
    line.fail("the deck generates more than " + format_count(static_cast<uint64_t>(most_generated)) +
                  " nodes and elements of a part",
              "save the mesh with all of its nodes and elements");
}

// Nodes on the straight line from one node to another. Source: Abaqus keywords reference guide, *NGEN.
void DeckPart::generate_nodes(const Keyword& ngen, const DeckLine& line) {
  refuse_parameters(ngen, {"line", "system"});
  const auto fields = line.fields();
  const uint64_t first = number_field(line, fields, 0), last = number_field(line, fields, 1);
  const int64_t step = whole_field(line, fields, 2, 1);
  const auto from = static_cast<int64_t>(first), to = static_cast<int64_t>(last);
  if (step == 0 || (to - from) % step != 0 || (to - from) / step < 1 || (to - from) / step > most_generated)
    line.fail("steps of " + std::to_string(step) + " do not lead from node " + std::to_string(first) + " to node " +
              std::to_string(last));
  count_generated(line, (to - from) / step);
  const Vec3 a = node_at(line, first), b = node_at(line, last);
  const std::string set = ngen.name_of("nset");
  if (!set.empty()) node_sets_[set].insert(node_sets_[set].end(), {first, last});
  for (int64_t number = from + step; number != to; number += step) {
    const double share = static_cast<double>(number - from) / static_cast<double>(to - from);
    add_node(line, static_cast<uint64_t>(number), a + share * (b - a), set);
  }
}

// Nodes between those of two sets. Source: Abaqus keywords reference guide, *NFILL.
void DeckPart::fill_nodes(const Keyword& nfill, const DeckLine& line) {
  refuse_parameters(nfill, {"bias", "two step", "singular"});
  const auto fields = line.fields();
  if (fields.size() < 2) line.fail("expected two sets of nodes, the number of intervals and the step of numbers");
  const Set first = node_set(line, fields[0]), second = node_set(line, fields[1]);
  const int64_t intervals = whole_field(line, fields, 2, 1), step = whole_field(line, fields, 3, 1);
  if (first.size() != second.size())
    line.fail("the sets have " + std::to_string(first.size()) + " and " + std::to_string(second.size()) +
              " nodes; they must have as many");
  if (intervals < 1 || intervals * static_cast<int64_t>(first.size()) > most_generated)
    line.fail("expected the number of intervals, found " + std::to_string(intervals));
  count_generated(line, intervals * static_cast<int64_t>(first.size()));
  const std::string set = nfill.name_of("nset");
  for (size_t n = 0; n < first.size(); ++n) {
    const Vec3 a = node_at(line, first[n]), b = node_at(line, second[n]);
    for (int64_t k = 1; k < intervals; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(intervals);
      const int64_t number = static_cast<int64_t>(first[n]) + k * step;
      add_node(line, deck_number(line, static_cast<double>(number)), a + share * (b - a), set);
    }
  }
}

// Rows of elements, rows of such rows, and layers of these. Source: Abaqus keywords reference guide, *ELGEN.
void DeckPart::generate_elements(const Keyword& elgen, const DeckLine& line) {
  const auto fields = line.fields();
  const Element master = element_at(line, number_field(line, fields, 0));
  struct Along {
    int64_t count = 1, nodes_by = 1, by = 1;
  };
  std::array<Along, 3> along;
  int64_t total = 1;
  for (size_t n = 0; n < 3; ++n) {
    along[n].count = whole_field(line, fields, 3 * n + 1, 1);
    along[n].nodes_by = whole_field(line, fields, 3 * n + 2, 1);
    along[n].by = whole_field(line, fields, 3 * n + 3, 1);
    if (along[n].count < 1 || along[n].count > most_generated) line.fail("expected the number of elements in a row");
    total *= along[n].count;
    if (total > most_generated) break;
  }
  count_generated(line, total);
  const std::string set = elgen.name_of("elset");
  if (!set.empty()) element_sets_[set].push_back(master.number);
  for (int64_t layer = 0; layer < along[2].count; ++layer)
    for (int64_t row = 0; row < along[1].count; ++row)
      for (int64_t n = 0; n < along[0].count; ++n) {
        if (layer == 0 && row == 0 && n == 0) continue;
        copy_element(line, master, n * along[0].by + row * along[1].by + layer * along[2].by,
                     n * along[0].nodes_by + row * along[1].nodes_by + layer * along[2].nodes_by, set);
      }
}

void DeckPart::copy_nodes(const Keyword& ncopy, const Affine& move) {
  const int64_t by = whole_parameter(ncopy, "change number", 0);
  const std::string set = ncopy.name_of("new set");
  const Set nodes = node_set(ncopy.line, ncopy.value("old set"));
  count_generated(ncopy.line, static_cast<int64_t>(nodes.size()));
  for (const uint64_t number : nodes)
    add_node(ncopy.line, deck_number(ncopy.line, static_cast<double>(static_cast<int64_t>(number) + by)),
             move(node_at(ncopy.line, number)), set);
}

void DeckPart::copy_elements(const Keyword& elcopy) {
  refuse_parameters(elcopy, {"reflect"});
  const std::string old_set = elcopy.name_of("old set"), set = elcopy.name_of("new set");
  const Set elements = element_set(old_set);
  if (elements.empty()) elcopy.line.fail("there is no set of elements " + formats::quoted(old_set));
  count_generated(elcopy.line, static_cast<int64_t>(elements.size()));
  for (const uint64_t number : elements)
    copy_element(elcopy.line, element_at(elcopy.line, number), whole_parameter(elcopy, "element shift", 0),
                 whole_parameter(elcopy, "shift nodes", 0), set);
}

void DeckPart::copy_element(const DeckLine& line, const Element& master, int64_t by, int64_t nodes_by,
                            const std::string& set) {
  std::vector<uint64_t> nodes;
  for (const uint64_t node : nodes_of(master))
    nodes.push_back(deck_number(line, static_cast<double>(static_cast<int64_t>(node) + nodes_by)));
  const auto number = deck_number(line, static_cast<double>(static_cast<int64_t>(master.number) + by));
  add_element(line, number, master.kind, nodes, set, master.is_shell);
}

DeckPart::Set DeckPart::node_set(const DeckLine& line, std::string_view name) const {
  if (const auto number = parse_number(name)) return {deck_number(line, *number)};
  const auto found = node_sets_.find(to_lower(name));
  if (found == node_sets_.end()) line.fail("there is no set of nodes " + formats::quoted(name));
  return unsorted_sets_.contains(found->first) ? found->second : sorted(found->second);
}

Vec3 DeckPart::node_at(const DeckLine& line, uint64_t number) const {
  const auto found = node_places_.find(number);
  if (found == node_places_.end()) line.fail("there is no node " + std::to_string(number));
  return nodes_[found->second].at;
}

DeckPart::Element DeckPart::element_at(const DeckLine& line, uint64_t number) const {
  const auto found = element_places_.find(number);
  if (found == element_places_.end()) line.fail("there is no element " + std::to_string(number));
  return elements_[found->second];
}

}  // namespace ombre::formats
