#ifdef OMBRE_3MF

#include "formats/containers/xml_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/greatest_coordinate.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

// Size of pugixml's data for an element or text, and for an attribute.
constexpr uint64_t node_bytes = 64, attribute_bytes = 40;
// Comments and DOCTYPE are skipped; text is stored in its element.
constexpr unsigned parse_options =
    pugi::parse_minimal | pugi::parse_escapes | pugi::parse_cdata | pugi::parse_embed_pcdata;

}  // namespace

std::string_view local_name(const char* name) {
  const std::string_view whole(name);
  const size_t colon = whole.rfind(':');
  return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

XmlFile::XmlFile(std::string name, std::string_view text, Diagnostics& diagnostics)
    : name_(std::move(name)), text_(text), diagnostics_(diagnostics) {
  check_size();
  const pugi::xml_parse_result result = tree_.load_buffer(text_.data(), text_.size(), parse_options);
  if (result) return;
  const auto place = static_cast<size_t>(std::max<ptrdiff_t>(result.offset, 0));
  fail_at(place, place, std::string("this is not XML: ") + to_lower(result.description()), "the file may be cut short");
}

// Each element begins with <, as does each end; each attribute has a =.
void XmlFile::check_size() const {
  uint64_t bytes = 0;
  for (const char c : text_) bytes += c == '<' ? node_bytes : c == '=' ? attribute_bytes : 0;
  if (bytes <= most_tree_bytes) return;
  fail(diagnostics_, name_,
       "this XML has too many elements: they would take " + format_count(bytes >> 20) + " MiB, at most " +
           format_count(most_tree_bytes >> 20) + " MiB are used",
       "save the mesh as STL, PLY or OBJ");
}

pugi::xml_node XmlFile::root(std::string_view wanted) const {
  const pugi::xml_node node = tree_.document_element();
  if (local_name(node) == wanted) return node;
  fail_at(node, "expected the element <" + std::string(wanted) + ">, found " + quoted(node.name()));
}

std::optional<std::string_view> XmlFile::attribute(pugi::xml_node node, std::string_view wanted) const {
  for (const pugi::xml_attribute& attribute : node.attributes())
    if (local_name(attribute.name()) == wanted) return attribute.value();
  return std::nullopt;
}

std::string_view XmlFile::required(pugi::xml_node node, std::string_view wanted) const {
  if (const auto value = attribute(node, wanted)) return *value;
  fail_at(node, '<' + std::string(node.name()) + "> lacks the attribute " + std::string(wanted));
}

double XmlFile::number(pugi::xml_node node, std::string_view text, std::string_view what) const {
  std::string_view digits = trim(text);
  if (digits.size() > 1 && digits.front() == '+') digits.remove_prefix(1);
  double value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, status] = std::from_chars(digits.data(), end, value);
  if (stop == end && status == std::errc() && std::isfinite(value)) return value;
  // The magnitude is below the least double.
  if (stop == end && status == std::errc::result_out_of_range && digits.find("e-") != std::string_view::npos) return 0;
  fail_at(node, "expected " + std::string(what) + ", found " + quoted(text));
}

double XmlFile::coordinate(pugi::xml_node node, std::string_view text, std::string_view what) const {
  const double value = number(node, text, what);
  if (std::abs(value) <= greatest_coordinate) return value + 0.0;  // maps -0 to 0
  fail_at(node, std::string(what) + " is too large: " + quoted(text), "coordinates may go up to 1e15");
}

uint64_t XmlFile::count(pugi::xml_node node, std::string_view text, std::string_view what) const {
  const std::string_view digits = trim(text);
  uint64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, status] = std::from_chars(digits.data(), end, value);
  if (status == std::errc() && stop == end) return value;
  fail_at(node, "expected " + std::string(what) + ", found " + quoted(text));
}

void XmlFile::fail_at(pugi::xml_node node, const std::string& message, const std::string& hint) const {
  // The position is that of the name, which follows <.
  const auto name_begin = static_cast<size_t>(std::max<ptrdiff_t>(node.offset_debug(), 1));
  fail_at(name_begin - 1, name_begin + std::string_view(node.name()).size(), message, hint);
}

// Positions in a text converted from UTF-16 may be beyond its end.
void XmlFile::fail_at(size_t begin, size_t end, const std::string& message, const std::string& hint) const {
  TextScanner(name_, text_, diagnostics_)
      .fail_at(std::min(begin, text_.size()), std::min(end, text_.size()), message, hint);
}

}  // namespace ombre::formats

#endif
