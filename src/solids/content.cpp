#include "solids/content.h"

#include <cstring>

namespace ombre::solids {
namespace {

// Appends values such that different lists of values give different texts.
class Writer {
 public:
  explicit Writer(std::string& text) : text_(text) {}

  template <class... Values>
  void add(const Values&... values) {
    (put(values), ...);
  }

 private:
  void put(double v) { bytes(v); }
  void put(bool v) { text_ += v ? '1' : '0'; }
  void put(int v) { bytes(v); }
  void put(size_t v) { bytes(v); }
  void put(const std::string& v) {
    bytes(v.size());
    text_ += v;
  }
  void put(const Vec2& v) { add(v.x, v.y); }
  void put(const Vec3& v) { add(v.x, v.y, v.z); }
  void put(const Affine& v) { add(v.rows[0], v.rows[1], v.rows[2], v.offset); }
  void put(const Fragments& v) { add(v.count, v.angle, v.size); }
  template <class T>
  void put(const std::optional<T>& v) {
    put(v.has_value());
    if (v) put(*v);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(list.size());
    for (const T& v : list) put(v);
  }
  template <class T, size_t n>
  void put(const std::array<T, n>& list) {
    for (const T& v : list) put(v);
  }

  template <class T>
  void bytes(T v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    text_.append(raw, sizeof v);
  }

  std::string& text_;
};

struct Adder {
  Writer& w;
  void operator()(const Cube& v) const { w.add(v.size, v.centred); }
  void operator()(const Sphere& v) const { w.add(v.radius, v.fragments); }
  void operator()(const Cylinder& v) const { w.add(v.height, v.bottom_radius, v.top_radius, v.centred, v.fragments); }
  void operator()(const Polyhedron& v) const { w.add(v.points, v.faces, v.wrong ? v.wrong->written : ""); }
  void operator()(const Square& v) const { w.add(v.size, v.centred); }
  void operator()(const Circle& v) const { w.add(v.radius, v.fragments); }
  void operator()(const Polygon& v) const { w.add(v.points, v.paths, v.wrong ? v.wrong->written : ""); }
  void operator()(const Text& v) const {
    w.add(v.text, v.size, v.font, v.horizontal, v.vertical, v.direction, v.language, v.script, v.spacing, v.fragments);
  }
  void operator()(const Import& v) const {
    w.add(v.path, v.layer, v.id, v.origin, v.scale, v.dots_per_inch, v.centred, v.is_painted, v.fragments);
  }
  void operator()(const Surface& v) const { w.add(v.path, v.centred, v.inverted); }
  void operator()(const Group&) const {}
  void operator()(const Union&) const {}
  void operator()(const Difference&) const {}
  void operator()(const Intersection&) const {}
  void operator()(const Hull&) const {}
  void operator()(const Minkowski&) const {}
  void operator()(const Fill&) const {}
  void operator()(const Transform& v) const { w.add(v.parent_from_child); }
  void operator()(const Resize& v) const { w.add(v.size, v.automatic); }
  void operator()(const Offset& v) const { w.add(v.distance, v.round, v.chamfer, v.fragments); }
  void operator()(const LinearExtrude& v) const {
    w.add(v.height, v.twist, v.direction, v.scale, v.centred, v.slices, v.segments, v.fragments);
  }
  void operator()(const RotateExtrude& v) const { w.add(v.angle, v.start, v.fragments); }
  void operator()(const Roof& v) const { w.add(static_cast<int>(v.method), v.fragments); }
  void operator()(const Projection& v) const { w.add(v.cut); }
  void operator()(const SetColour& v) const { w.add(v.colour); }
  void operator()(const SetPart& v) const { w.add(v.name); }
  void operator()(const SetMaterial& v) const { w.add(v.name); }
  void operator()(const Word& v) const { w.add(v.name, v.arguments); }
};

}  // namespace

std::string text_of(const Tree& tree) {
  std::string text;
  Writer writer(text);
  writer.add(tree.operation.index(), static_cast<int>(tree.semantics));
  std::visit(Adder{writer}, tree.operation);
  return text;
}

}  // namespace ombre::solids
