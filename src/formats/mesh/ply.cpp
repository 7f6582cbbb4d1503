// Reads PLY: a header that lists elements and their properties, followed by their values as text or binary.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_builder.h"
#include "formats/mesh/ply_header.h"

namespace ombre::formats {
namespace {

// Reads values in any of the three encodings.
class Values {
 public:
  Values(TextScanner& scanner, PlyEncoding encoding, const std::string& name, std::string_view bytes,
         Diagnostics& diagnostics)
      : scanner_(scanner),
        encoding_(encoding),
        name_(name),
        bytes_(bytes),
        diagnostics_(diagnostics),
        at_(scanner.position()) {}

  size_t remaining() const { return encoding_ == PlyEncoding::ascii ? scanner_.remaining() : bytes_.size() - at_; }

  double number(PlyType type, std::string_view what) {
    if (encoding_ == PlyEncoding::ascii) return scanner_.number(what);
    const size_t size = byte_size(type);
    need(size, what);
    const double value = load(type);
    at_ += size;
    return value;
  }

  void skip(PlyType type, uint64_t count, std::string_view what) {
    if (encoding_ != PlyEncoding::ascii) {
      need(count * byte_size(type), what);
      at_ += count * byte_size(type);
      return;
    }
    for (uint64_t i = 0; i < count; ++i)
      if (scanner_.word().empty()) scanner_.fail_here("expected " + std::string(what) + ", but the file ends here");
  }

  // Reads the length of a list, and checks that the file has room for it.
  uint64_t length(const PlyProperty& property) {
    const double length = number(property.count_type, "the length of a list");
    const size_t least = encoding_ == PlyEncoding::ascii ? 2 : byte_size(property.type);
    const size_t most = (remaining() + 1) / least;
    if (length >= 0 && length == std::floor(length) && length <= static_cast<double>(most))
      return static_cast<uint64_t>(length);
    fail_at_value(property.count_type,
                  "a list of " + format_number(length) + " values is more than the file has room for");
  }

  // Reports an error at the value that was read last.
  [[noreturn]] void fail_at_value(PlyType type, const std::string& message) const {
    if (encoding_ == PlyEncoding::ascii) scanner_.fail_at_word(message);
    fail(diagnostics_, name_, message + " (at byte " + format_count(at_ - byte_size(type)) + ")");
  }

 private:
  void need(uint64_t size, std::string_view what) const {
    if (size <= bytes_.size() - at_) return;
    fail(diagnostics_, name_,
         "this PLY is cut short: expected " + std::string(what) + " at byte " + format_count(at_) + ", the file has " +
             format_count(bytes_.size()) + " bytes");
  }

  // Returns the bytes of the next value as an unsigned number.
  uint64_t load_bits(size_t size) const {
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i) {
      const size_t from = encoding_ == PlyEncoding::big_endian ? i : size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + from]);
    }
    return bits;
  }

  double load(PlyType type) const {
    const uint64_t bits = load_bits(byte_size(type));
    switch (type) {
      case PlyType::int8:
        return static_cast<int8_t>(bits);
      case PlyType::int16:
        return static_cast<int16_t>(bits);
      case PlyType::int32:
        return static_cast<int32_t>(bits);
      case PlyType::float32:
        return std::bit_cast<float>(static_cast<uint32_t>(bits));
      case PlyType::float64:
        return std::bit_cast<double>(bits);
      case PlyType::uint8:
      case PlyType::uint16:
      case PlyType::uint32:
        break;
    }
    return static_cast<double>(bits);
  }

  TextScanner& scanner_;
  PlyEncoding encoding_;
  const std::string& name_;
  std::string_view bytes_;
  Diagnostics& diagnostics_;
  size_t at_;  // position of binary values
};

// The meaning of a property for the mesh.
enum class Role { none, x, y, z, u, v, red, green, blue, alpha, corners };

Role vertex_role(const PlyProperty& property) {
  if (property.is_list) return Role::none;
  const std::string& name = property.name;
  if (name == "x") return Role::x;
  if (name == "y") return Role::y;
  if (name == "z") return Role::z;
  if (name == "s" || name == "u" || name == "texture_u") return Role::u;
  if (name == "t" || name == "v" || name == "texture_v") return Role::v;
  const std::string_view colour = std::string_view(name).substr(name.starts_with("diffuse_") ? 8 : 0);
  if (colour == "red") return Role::red;
  if (colour == "green") return Role::green;
  if (colour == "blue") return Role::blue;
  if (colour == "alpha") return Role::alpha;
  return Role::none;
}

Role face_role(const PlyProperty& property) {
  const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
  return property.is_list && is_corners ? Role::corners : Role::none;
}

class PlyReader {
 public:
  PlyReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics),
        header_(read_ply_header(scanner_)),
        values_(scanner_, header_.encoding, name, bytes, diagnostics),
        name_(name),
        diagnostics_(diagnostics) {}

  Mesh read() {
    is_one_a_line_ = header_.encoding == PlyEncoding::ascii && scanner_.has_lines(text_lines());
    for (const PlyElement& element : header_.elements) {
      check_fits(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element, &PlyReader::read_face);
      else if (element.name == "tristrips")
        read_faces(element, &PlyReader::read_strips);
      else
        skip_element(element);
    }
    warnings_.report(name_, diagnostics_);
    if (builder_.triangle_count() == 0) fail(diagnostics_, name_, "this PLY file has no faces");
    return builder_.finish().mesh;
  }

 private:
  // Returns the number of lines if each element of a text file has its own. Then further values of a line are ignored;
  // if there are fewer lines, line ends have no meaning.
  uint64_t text_lines() const {
    uint64_t lines = 0;
    for (const PlyElement& element : header_.elements)
      if (!element.properties.empty()) lines += std::min(element.count, UINT64_MAX - lines);
    return lines;
  }

  void end_element() {
    if (is_one_a_line_) scanner_.next_line();
  }

  void check_fits(const PlyElement& element) const {
    const size_t least = least_bytes(element, header_.encoding);
    if (least == 0 || element.count <= (values_.remaining() + 1) / least) return;
    fail(diagnostics_, name_,
         "this PLY is cut short: its header promises " + format_count(element.count) + " of " +
             formats::quoted(element.name) + " (at least " + std::to_string(least) + " bytes each), the file has " +
             format_count(values_.remaining()) + " bytes left");
  }

  void skip_property(const PlyProperty& property) {
    const uint64_t count = property.is_list ? values_.length(property) : 1;
    values_.skip(property.type, count, "a value of " + formats::quoted(property.name));
  }

  void warn_of(const PlyElement& element) {
    constexpr std::string_view harmless[]{"edge", "camera", "user", "material", "viewpoint", "obj_info"};
    if (std::find(std::begin(harmless), std::end(harmless), element.name) != std::end(harmless)) return;
    const std::string name = ' ' + formats::quoted(element.name);
    warnings_.add("an element" + name + " is not read", "elements" + name + " are not read", element.count);
  }

  void skip_element(const PlyElement& element) {
    if (element.properties.empty()) return;
    warn_of(element);
    for (uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) skip_property(property);
      end_element();
    }
  }

  static std::vector<Role> roles(const PlyElement& element, Role (*role)(const PlyProperty&)) {
    std::vector<Role> found;
    for (const PlyProperty& property : element.properties) found.push_back(role(property));
    return found;
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<Role> found = roles(element, vertex_role);
    const auto has = [&](Role role) { return std::find(found.begin(), found.end(), role) != found.end(); };
    if (!has(Role::x) || !has(Role::y) || !has(Role::z))
      fail(diagnostics_, name_, "the vertices of this PLY file lack one of the properties x, y, z");
    if (element.count > MeshBuilder::most_vertices || builder_.vertex_count() > 0)
      fail(diagnostics_, name_, "this PLY file has too many vertices, or lists them twice");
    has_texture_ = has(Role::u) && has(Role::v);
    has_colours_ = has(Role::red) && has(Role::green) && has(Role::blue);
    for (uint64_t i = 0; i < element.count; ++i) read_vertex(element, found);
  }

  void read_vertex(const PlyElement& element, const std::vector<Role>& found) {
    Vec3 p;
    double u = 0, v = 0;
    std::array<double, 4> colour{0, 0, 0, 1};
    for (size_t i = 0; i < found.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      switch (found[i]) {
        case Role::x:
          p.x = coordinate(property);
          break;
        case Role::y:
          p.y = coordinate(property);
          break;
        case Role::z:
          p.z = coordinate(property);
          break;
        case Role::u:
          u = coordinate(property);
          break;
        case Role::v:
          v = coordinate(property);
          break;
        case Role::red:
        case Role::green:
        case Role::blue:
        case Role::alpha:
          colour[static_cast<size_t>(found[i]) - static_cast<size_t>(Role::red)] = part_of_colour(property);
          break;
        case Role::corners:
        case Role::none:
          skip_property(property);
          break;
      }
    }
    builder_.add_vertex(p);
    if (has_colours_) builder_.add_colour(colour);
    if (has_texture_) builder_.add_texture_coordinate(u, v);
    end_element();
  }

  // Returns a share: integers are shares of the greatest of their type.
  double part_of_colour(const PlyProperty& property) {
    const double value = values_.number(property.type, "a part of a colour"),
                 share = value / greatest_of(property.type);
    return share >= 0 && share <= 1 ? share : share > 1 ? 1 : 0;
  }
  static double greatest_of(PlyType type) {
    switch (type) {
      case PlyType::uint8:
      case PlyType::int8:
        return 255;
      case PlyType::uint16:
      case PlyType::int16:
        return 65535;
      case PlyType::uint32:
      case PlyType::int32:
        return UINT32_MAX;
      case PlyType::float32:
      case PlyType::float64:
        break;
    }
    return 1;
  }

  double coordinate(const PlyProperty& property) {
    const double value = values_.number(property.type, "a coordinate of a vertex");
    if (!(std::abs(value) <= greatest_coordinate))
      values_.fail_at_value(property.type, "the coordinate " + property.name + " of vertex " +
                                               format_count(builder_.vertex_count()) + " is " + format_number(value) +
                                               ", which is not a usable number");
    return value + 0.0;  // maps -0 to 0
  }

  void read_faces(const PlyElement& element, void (PlyReader::*read_one)(const PlyProperty&, uint64_t)) {
    const std::vector<Role> found = roles(element, face_role);
    if (std::find(found.begin(), found.end(), Role::corners) == found.end())
      fail(diagnostics_, name_, "the faces of this PLY file lack the list vertex_indices");
    for (uint64_t i = 0; i < element.count; ++i) {
      for (size_t p = 0; p < found.size(); ++p) {
        if (found[p] == Role::corners)
          (this->*read_one)(element.properties[p], i);
        else
          skip_property(element.properties[p]);
      }
      end_element();
    }
  }

  void read_face(const PlyProperty& property, uint64_t number) {
    const uint64_t count = values_.length(property);
    corners_.clear();
    for (uint64_t i = 0; i < count; ++i)
      corners_.push_back(corner(property, values_.number(property.type, "the number of a vertex"), number));
    if (count < 3)
      return warnings_.add("a face of fewer than three corners is no part of the surface",
                           "faces of fewer than three corners are no part of the surface");
    add_face();
  }

  // Reads triangle strips, each ended by -1: every corner forms a triangle with the two before it, with alternating
  // orientation.
  void read_strips(const PlyProperty& property, uint64_t number) {
    const uint64_t count = values_.length(property);
    std::vector<uint32_t> strip;
    for (uint64_t i = 0; i < count; ++i) {
      const double value = values_.number(property.type, "the number of a vertex");
      if (value == -1) {
        strip.clear();
        continue;
      }
      strip.push_back(corner(property, value, number));
      if (strip.size() < 3) continue;
      const size_t n = strip.size() - 1;
      const bool is_even = strip.size() % 2 == 1;
      corners_ = {strip[is_even ? n - 2 : n - 1], strip[is_even ? n - 1 : n - 2], strip[n]};
      add_face();
    }
  }

  uint32_t corner(const PlyProperty& property, double value, uint64_t number) const {
    if (value >= 0 && value < static_cast<double>(builder_.vertex_count()) && value == std::floor(value))
      return static_cast<uint32_t>(value);
    values_.fail_at_value(property.type, "face " + format_count(number) + " uses vertex " + format_number(value) +
                                             ", but the " + format_count(builder_.vertex_count()) +
                                             " vertices before it are numbered from 0");
  }

  void add_face() {
    builder_.add_polygon(corners_, has_texture_ ? std::span<const uint32_t>(corners_) : std::span<const uint32_t>());
  }

  TextScanner scanner_;
  PlyHeader header_;
  Values values_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  MeshBuilder builder_;
  std::vector<uint32_t> corners_;
  CountedWarnings warnings_;
  bool has_texture_ = false, has_colours_ = false;
  bool is_one_a_line_ = false;
};

}  // namespace

bool is_ply(std::string_view bytes) { return bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r"; }

std::optional<Mesh> read_ply(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] { return PlyReader(name, bytes, diagnostics).read(); });
}

}  // namespace ombre::formats
