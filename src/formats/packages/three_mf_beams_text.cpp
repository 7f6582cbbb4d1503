#include "formats/packages/three_mf_beams_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "formats/containers/append_numbers.h"
#include "formats/containers/xml_text.h"

namespace ombre::formats {
namespace {

constexpr std::string_view cap_texts[]{"sphere", "hemisphere", "butt"};
constexpr std::string_view clipping_texts[]{"none", "inside", "outside"};

std::string_view word(BeamCap cap) { return cap_texts[static_cast<size_t>(cap)]; }

// Finds the most frequent value; the least of several equally frequent ones.
template <class T>
class MostFrequent {
 public:
  void add(T value) { ++counts_[value]; }
  T value() const {
    const auto rarer = [](const auto& a, const auto& b) { return a.second < b.second; };
    return std::max_element(counts_.begin(), counts_.end(), rarer)->first;
  }

 private:
  std::map<T, size_t> counts_;
};

// Defaults of the lattice; beams only state differences from them.
struct Usual {
  float radius = 0;
  BeamCap cap = BeamCap::sphere;
  uint32_t material = 0;
};

Usual usual_of(const WrittenBeams& written) {
  MostFrequent<float> radius;
  MostFrequent<BeamCap> cap;
  MostFrequent<uint32_t> material;
  for (const Beam& beam : written.beams)
    for (const size_t end : {0, 1}) {
      radius.add(static_cast<float>(beam.radii[end]));
      cap.add(beam.caps[end]);
    }
  for (const uint32_t own : written.materials) material.add(own);
  return {radius.value(), cap.value(), written.materials.empty() ? 0 : material.value()};
}

Vec3 rounded(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }

// Returns a number less than the length of every beam, even for programs that compute in single precision.
double least_length(const WrittenBeams& written) {
  constexpr double rounding = 1e-4;
  double least = std::numeric_limits<double>::infinity();
  for (const Beam& beam : written.beams) {
    const Vec3 start = rounded(written.vertices[beam.ends[0]]), end = rounded(written.vertices[beam.ends[1]]);
    least = std::min(least, length(end - start));
  }
  return (1 - rounding) * least;
}

void append_beam(std::string& text, const WrittenBeams& written, const Usual& usual, size_t index) {
  const Beam& beam = written.beams[index];
  text += "<b:beam";
  append_xml_attribute(text, "v1", append_count, beam.ends[0]);
  append_xml_attribute(text, "v2", append_count, beam.ends[1]);
  // If r1 is written, r2 defaults to it; otherwise both default to the lattice's radius.
  const auto first = static_cast<float>(beam.radii[0]), second = static_cast<float>(beam.radii[1]);
  if (first != usual.radius || second != usual.radius) append_xml_attribute(text, "r1", append_float, first);
  if (first != second) append_xml_attribute(text, "r2", append_float, second);
  if (beam.caps[0] != usual.cap) text += xml_attribute("cap1", word(beam.caps[0]));
  if (beam.caps[1] != usual.cap) text += xml_attribute("cap2", word(beam.caps[1]));
  if (!written.materials.empty() && written.materials[index] != usual.material) {
    append_xml_attribute(text, "p1", append_count, written.materials[index]);
    append_xml_attribute(text, "p2", append_count, written.materials[index]);
  }
  text += "/>\n";
}

}  // namespace

LazyBytes beam_lattice_text(const WrittenBeams& written, std::optional<uint64_t> clip, uint64_t materials) {
  const Usual usual = usual_of(written);
  std::string begin = "<b:beamlattice";
  append_xml_attribute(begin, "minlength", append_float, least_length(written));
  append_xml_attribute(begin, "radius", append_float, usual.radius);
  if (clip) {
    begin += xml_attribute("clippingmode", clipping_texts[static_cast<size_t>(written.clipping)]);
    append_xml_attribute(begin, "clippingmesh", append_count, *clip);
  }
  if (!written.materials.empty()) {
    append_xml_attribute(begin, "pid", append_count, materials);
    append_xml_attribute(begin, "pindex", append_count, usual.material);
  }
  if (usual.cap != BeamCap::sphere) begin += xml_attribute("cap", word(usual.cap));
  LazyBytes bytes;
  bytes.add(begin + ">\n<b:beams>\n");
  bytes.add_rows(written.beams.size(),
                 [&written, usual](std::string& text, size_t index) { append_beam(text, written, usual, index); });
  bytes.add("</b:beams>\n</b:beamlattice>\n");
  return bytes;
}

}  // namespace ombre::formats
