// Reads the beam lattices of a 3MF model (3MF Beam Lattice Extension 1.2, with its balls).
#ifdef OMBRE_3MF

#include "formats/packages/three_mf_beams.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

constexpr std::string_view clipping_words[]{"none", "inside", "outside"};
constexpr std::string_view ball_words[]{"none", "mixed", "all"};
constexpr std::string_view cap_words[]{"sphere", "hemisphere", "butt"};

constexpr uint32_t unused = UINT32_MAX;

enum class BallMode : uint8_t { none, mixed, all };

class LatticeReader {
 public:
  LatticeReader(const XmlFile& file, xml_node element, const PropertyTable& properties, const PropertyReference& usual,
                const Mesh& mesh)
      : file_(file),
        element_(element),
        properties_(properties),
        usual_(properties.reference(element, "pindex", usual)),
        vertices_(mesh.vertices),
        cap_(word(element, "cap", cap_words, BeamCap::sphere)),
        number_(vertices_.size(), unused) {}

  void read(const ClippingMeshes& clipping_meshes, CountedWarnings& warnings, Mesh& mesh) {
    read_beams(warnings);
    read_balls();
    read_clipping(clipping_meshes);
    for (Part& part : parts_in_order()) mesh.lattices.push_back(finished(std::move(part)));
  }

 private:
  // The beams and balls with one property.
  struct Part {
    PropertyReference property;
    xml_node user;                        // the first element with that property
    size_t last_beam = 0, last_ball = 0;  // counted from 1; 0 for none
    BeamLattice lattice = {};
  };

  template <class Value, size_t count>
  Value word(xml_node node, std::string_view attribute, const std::string_view (&words)[count], Value usual) const {
    const auto text = file_.attribute(node, attribute);
    if (!text) return usual;
    const auto found = std::find(std::begin(words), std::end(words), *text);
    if (found == std::end(words))
      file_.fail_at(node, std::string(attribute) + " is " + quoted(*text),
                    "it can be " + join(std::vector<std::string>(std::begin(words), std::end(words)), ", "));
    return static_cast<Value>(found - std::begin(words));
  }

  double size(xml_node node, std::string_view text, std::string_view what) const {
    const double value = file_.coordinate(node, text, what);
    if (value <= 0) file_.fail_at(node, std::string(what) + " is " + quoted(text), "it must be greater than 0");
    return value;
  }

  std::optional<double> size_of(xml_node node, std::string_view attribute, std::string_view what) const {
    const auto text = file_.attribute(node, attribute);
    return text ? std::optional(size(node, *text, what)) : std::nullopt;
  }

  Part& part_of(const PropertyReference& property, xml_node user) {
    const auto [known, is_new] = numbers_.try_emplace(property, parts_.size());
    if (is_new) parts_.push_back({property, user});
    return parts_[known->second];
  }

  void read_beams(CountedWarnings& warnings) {
    const auto shortest = size_of(element_, "minlength", "the least length of a beam");
    const auto radius = size_of(element_, "radius", "the radius of beams");
    size_t count = 0;
    for (const xml_node node : child_of(element_, "beams").children()) {
      if (local_name(node) != "beam") continue;
      ++count;
      const Beam beam = read_beam(node, radius);
      const double length = ombre::length(vertices_[beam.ends[1]] - vertices_[beam.ends[0]]);
      if (length == 0 || length < shortest.value_or(0)) {
        warnings.add("a beam that is shorter than its lattice's minlength is left out",
                     "beams that are shorter than their lattice's minlength are left out");
        continue;
      }
      Part& part = part_of(properties_.reference(node, {"p1", "p2"}, usual_), node);
      part.last_beam = count;
      part.lattice.beams.push_back(beam);
    }
  }

  Beam read_beam(xml_node node, std::optional<double> radius) const {
    const auto first = size_of(node, "r1", "the radius of a beam"),
               second = size_of(node, "r2", "the radius of a beam");
    if (!first && !radius) file_.fail_at(node, "the beam has no radius, and its lattice has none either");
    const double start = first ? *first : *radius;
    return {{vertex(node, "v1"), vertex(node, "v2")},
            {start, second.value_or(start)},
            {word(node, "cap1", cap_words, cap_), word(node, "cap2", cap_words, cap_)}};
  }

  uint32_t vertex(xml_node node, std::string_view attribute) const {
    return vertex_number(file_, node, attribute, vertices_.size());
  }

  // Reads the balls: those with elements, and those at other vertices of beams if the mode requires them.
  void read_balls() {
    const auto mode = word(element_, "ballmode", ball_words, BallMode::none);
    if (mode == BallMode::none) return;
    const auto radius = size_of(element_, "ballradius", "the radius of balls");
    std::vector<bool> done(vertices_.size());
    size_t count = 0;
    for (const xml_node node : child_of(element_, "balls").children()) {
      if (local_name(node) != "ball") continue;
      const auto own = size_of(node, "r", "the radius of a ball");
      if (!own && !radius) file_.fail_at(node, "the ball has no radius, and its lattice has no ballradius");
      const uint32_t centre = vertex(node, "vindex");
      done[centre] = true;
      add_ball({centre, own ? *own : *radius}, properties_.reference(node, "p", usual_), node, ++count);
    }
    if (mode == BallMode::all) add_usual_balls(radius, done, count);
  }

  void add_usual_balls(std::optional<double> radius, std::vector<bool>& done, size_t count) {
    std::vector<uint32_t> centres;
    for (const Part& part : parts_)
      for (const Beam& beam : part.lattice.beams)
        for (const uint32_t end : beam.ends) {
          if (!done[end]) centres.push_back(end);
          done[end] = true;
        }
    if (!centres.empty() && !radius) file_.fail_at(element_, "the lattice has balls at all vertices but no ballradius");
    for (const uint32_t centre : centres) add_ball({centre, *radius}, usual_, element_, ++count);
  }

  void add_ball(const Ball& ball, const PropertyReference& property, xml_node user, size_t number) {
    Part& part = part_of(property, user);
    part.last_ball = number;
    part.lattice.balls.push_back(ball);
  }

  void read_clipping(const ClippingMeshes& clipping_meshes) {
    clipping_ = word(element_, "clippingmode", clipping_words, LatticeClipping::none);
    if (clipping_ == LatticeClipping::none) return;
    const auto id = file_.attribute(element_, "clippingmesh");
    if (!id) file_.fail_at(element_, "the lattice is clipped, but has no clippingmesh");
    clip_ = clipping_meshes(element_, file_.count(element_, *id, "the number of an object"));
  }

  std::vector<Part> parts_in_order() {
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
      return std::pair(a.last_beam, a.last_ball) > std::pair(b.last_beam, b.last_ball);
    });
    return std::move(parts_);
  }

  PlacedLattice finished(Part part) {
    take_used_vertices(part.lattice);
    part.lattice.clipping = clipping_;
    part.lattice.clip = clip_;
    PlacedLattice placed;
    properties_.describe(part.property, part.user, placed.group);
    placed.lattice = std::make_shared<const BeamLattice>(std::move(part.lattice));
    return placed;
  }

  void take_used_vertices(BeamLattice& lattice) {
    std::vector<uint32_t> used;
    const auto take = [&](uint32_t& vertex) {
      if (number_[vertex] == unused) {
        number_[vertex] = static_cast<uint32_t>(used.size());
        used.push_back(vertex);
        lattice.vertices.push_back(vertices_[vertex]);
      }
      vertex = number_[vertex];
    };
    for (Beam& beam : lattice.beams)
      for (uint32_t& end : beam.ends) take(end);
    for (Ball& ball : lattice.balls) take(ball.centre);
    for (const uint32_t vertex : used) number_[vertex] = unused;
  }

  const XmlFile& file_;
  xml_node element_;
  const PropertyTable& properties_;
  PropertyReference usual_;
  const std::vector<Vec3>& vertices_;
  BeamCap cap_;
  LatticeClipping clipping_ = LatticeClipping::none;
  std::shared_ptr<const Mesh> clip_;
  std::vector<Part> parts_;
  std::map<PropertyReference, size_t> numbers_;  // by property: number of the part
  std::vector<uint32_t> number_;                 // by vertex: number in the lattice that is being finished
};

}  // namespace

void add_lattices(const XmlFile& file, xml_node element, const PropertyTable& properties,
                  const PropertyReference& usual, const ClippingMeshes& clipping_meshes, CountedWarnings& warnings,
                  Mesh& mesh) {
  LatticeReader(file, element, properties, usual, mesh).read(clipping_meshes, warnings, mesh);
}

}  // namespace ombre::formats

#endif
