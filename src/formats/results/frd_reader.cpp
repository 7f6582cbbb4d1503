// Reads results of CalculiX (.frd) as text: nodes, elements, and the values of one step at nodes. Sources: G. Dhondt,
// CalculiX CrunchiX User's Manual and the manual of CalculiX GraphiX, "Result Format".
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/result_steps.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

std::optional<ElementKind> frd_kind(uint64_t type) {
  static const std::map<uint64_t, ElementKind> kinds{{1, ElementKind::brick8},
                                                     {2, ElementKind::wedge6},
                                                     {3, ElementKind::tetrahedron4},
                                                     {4, ElementKind::brick20},
                                                     {6, ElementKind::tetrahedron10}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

// Returns true for shells and beams, which are left out.
bool is_flat_in_frd(uint64_t type) { return type >= 7 && type <= 12; }

// Returns the usual name of a field for its name in CalculiX.
std::string plain_name(const std::string& name) {
  static const std::map<std::string, std::string> names{
      {"DISP", "displacement"}, {"STRESS", "stress"}, {"TOSTRAIN", "strain"}, {"NDTEMP", "temperature"},
      {"FORC", "force"},        {"ERROR", "error"},   {"FLUX", "flux"},       {"MESTRAIN", "mechanical strain"}};
  const auto found = names.find(name);
  return found == names.end() ? name : found->second;
}

class FrdReader {
 public:
  FrdReader(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics)
      : name_(name), bytes_(bytes), scanner_(name, bytes, diagnostics), diagnostics_(diagnostics), wanted_(step) {}

  Results run() {
    while (next()) {
      if (word(0, 6) == "2C")
        read_nodes();
      else if (word(0, 6) == "3C")
        read_elements();
      else if (word(0, 6) == "100C")
        read_field();
      else if (trim(line_) == "9999")
        break;
    }
    if (wanted_ > 0) step_index(name_, times_, wanted_, diagnostics_);
    mesh_.results.step_times = times_;
    mesh_.results.step = times_.size() == 1 ? 1 : wanted_;
    leave_out(mesh_.results, name_, flat_, "shells and beams", diagnostics_);
    return std::move(mesh_.results);
  }

 private:
  [[noreturn]] void fail_line(const std::string& message) const { scanner_.fail_at(begin_, end_, message); }

  bool next() {
    if (at_ >= bytes_.size()) return false;
    begin_ = at_;
    end_ = std::min(bytes_.find('\n', at_), bytes_.size());
    at_ = end_ + 1;
    line_ = bytes_.substr(begin_, end_ - begin_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    return true;
  }
  // Reads the next line of a block; returns an empty text at the block's end.
  std::string_view next_in_block() {
    if (!next()) fail_line("the file is cut off");
    const std::string_view key = word(0, 3);
    return key == "-3" ? std::string_view() : key;
  }

  std::string_view word(size_t begin, size_t size) const {
    return begin < line_.size() ? trim(line_.substr(begin, size)) : std::string_view();
  }
  uint64_t whole(size_t begin, size_t size) const {
    const std::string_view text = word(begin, size);
    uint64_t value = 0;
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || stop != text.data() + text.size())
      fail_line("expected a whole number in column " + std::to_string(begin + 1) + ", found " + formats::quoted(text));
    return value;
  }
  // Parses a number; CalculiX omits the E of exponents of three digits.
  double number(size_t begin) const {
    std::string text(word(begin, number_size));
    if (text.size() > 4 && (text[text.size() - 4] == '-' || text[text.size() - 4] == '+') &&
        text.find('E') == std::string::npos)
      text.insert(text.size() - 4, "E");
    const std::string small = to_lower(text);
    if (small == "nan" || small.find("inf") != std::string::npos) return std::nan("");
    const auto value = parse_number(text);
    if (!value)
      fail_line("expected a number in column " + std::to_string(begin + 1) + ", found " + formats::quoted(text));
    return *value;
  }

  // Reads the format of a block, which is the last number of its first line.
  void read_format() {
    const std::string_view text = trim(line_);
    const char format = text.empty() ? ' ' : text.back();
    if (format == '2' || format == '3') fail_line("binary .frd files are not read");
    id_size_ = format == '0' ? 5 : 10;
  }

  void read_nodes() {
    read_format();
    for (std::string_view key = next_in_block(); !key.empty(); key = next_in_block()) {
      const size_t at = 3 + id_size_;
      const Vec3 point{number(at), number(at + number_size), number(at + 2 * number_size)};
      if (!is_finite(point)) fail_line("a coordinate is not finite");
      if (!mesh_.add_node(whole(3, id_size_), point)) fail_line("this node comes twice");
    }
  }

  void read_elements() {
    read_format();
    std::optional<ElementKind> kind;
    uint64_t element = 0;
    std::vector<uint64_t> nodes;
    const auto finish = [&] {
      if (kind && element > 0) add_element(*kind, element, nodes);
      nodes.clear();
    };
    for (std::string_view key = next_in_block(); !key.empty(); key = next_in_block()) {
      if (key == "-1") {
        finish();
        element = whole(3, id_size_);
        const uint64_t type = whole(3 + id_size_, 5);
        kind = frd_kind(type);
        if (!kind && !is_flat_in_frd(type))
          fail_line("elements of the type " + std::to_string(type) + " are not read, as wedges of 15 nodes (5)");
        flat_ += kind ? 0 : 1;
      } else {
        for (size_t at = 3; at < line_.size() && !word(at, id_size_).empty(); at += id_size_)
          nodes.push_back(whole(at, id_size_));
      }
    }
    finish();
  }

  void add_element(ElementKind kind, uint64_t element, std::vector<uint64_t>& nodes) {
    if (nodes.size() != node_count(kind))
      fail_line("element " + std::to_string(element) + " has " + std::to_string(nodes.size()) +
                " nodes; its kind has " + std::to_string(node_count(kind)));
    // In .frd files, the nodes of vertical edges precede those of the upper side.
    if (kind == ElementKind::brick20) std::rotate(nodes.begin() + 12, nodes.begin() + 16, nodes.end());
    const std::string wrong = mesh_.add_element(kind, element, nodes);
    if (!wrong.empty()) fail_line(wrong);
  }

  // Returns the number, from 1, of the step to which the block of this line belongs. All blocks of a step have its
  // number and its time.
  size_t step_of_block() {
    const std::string time(word(12, 12)), key = std::string(word(58, 5)) + ' ' + time;
    const auto [found, is_new] = steps_.emplace(key, steps_.size() + 1);
    if (is_new) times_.push_back(time);
    return found->second;
  }

  void read_field() {
    read_format();
    ResultField field;
    field.step = step_of_block();
    const bool is_wanted = wanted_ == 0 || field.step == wanted_;
    size_t components = 0;
    next_value_ = values_end_ = 0;
    for (std::string_view key = next_in_block(); !key.empty(); key = next_in_block()) {
      if (key == "-4") {
        field.name = plain_name(std::string(word(5, 8)));
      } else if (key == "-5") {
        // The length of a vector is listed as a component, but not in the file.
        if (!field.values.empty()) fail_line("the name of a component comes behind values");
        if (word(5, 8) != "ALL") ++components;
      } else if (key == "-1" || key == "-2") {
        add_values(key == "-1", components, field);
      } else {
        fail_line("expected a line that begins with -1, found " + formats::quoted(key));
      }
    }
    if (!is_wanted || field.name.empty() || field.values.empty()) return;
    // A field of a later step replaces the earlier one.
    std::erase_if(mesh_.results.fields, [&](const ResultField& known) { return known.name == field.name; });
    mesh_.results.fields.push_back(std::move(field));
  }

  void add_values(bool is_first, size_t components, ResultField& field) {
    if (components == 0) fail_line("values come before the names of their components");
    if (components > 9) return;
    if (field.values.empty()) {
      field.components = components;
      field.values.assign(components * mesh_.results.points.size(), std::nan(""));
    }
    if (is_first) {
      const auto found = mesh_.node_places.find(whole(3, id_size_));
      if (found == mesh_.node_places.end()) fail_line("there is no node of this number");
      next_value_ = found->second * components;
      values_end_ = next_value_ + components;
    }
    for (size_t at = 3 + id_size_; next_value_ < values_end_ && !word(at, number_size).empty(); at += number_size)
      field.values[next_value_++] = number(at);
  }

  static constexpr size_t number_size = 12;

  const std::string& name_;
  std::string_view bytes_, line_;
  TextScanner scanner_;
  Diagnostics& diagnostics_;
  size_t at_ = 0, begin_ = 0, end_ = 0;
  size_t id_size_ = 10;
  size_t next_value_ = 0, values_end_ = 0;
  uint64_t flat_ = 0;
  uint64_t wanted_ = 0;                  // number of the step, or 0
  std::map<std::string, size_t> steps_;  // by number and time in the file
  std::vector<std::string> times_;       // by step
  NumberedResults mesh_;
};

}  // namespace

Results read_frd(const std::string& name, std::string_view bytes, uint64_t step, Diagnostics& diagnostics) {
  return FrdReader(name, bytes, step, diagnostics).run();
}

}  // namespace ombre::formats
