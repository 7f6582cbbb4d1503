#include "solids/mended_solid.h"

#include <map>
#include <set>
#include <utility>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/mesh/polygon.h"
#include "import/surfaces/corner_welder.h"
#include "solids/kernel.h"

namespace ombre::solids {
namespace {

class Mender {
 public:
  Mender(TriangleMesh& mesh, const std::string& what, const SourceRange& where, Diagnostics& messages)
      : mesh_(mesh), what_(what), where_(where), messages_(messages) {}

  // Joins corners that differ by rounding, if that closes the surface.
  bool join_corners() {
    formats::Mesh joined;
    joined.vertices = mesh_.points;
    joined.triangles.assign(mesh_.triangles.begin(), mesh_.triangles.end());
    const auto welded = importing::weld_corners(joined, false);
    if (!welded) return false;
    mesh_.points = std::move(joined.vertices);
    mesh_ = tidied(mesh_);
    messages_.note(where_, format_count(welded->corners) + " corners of " + what_ + " that lie up to " +
                               format_rounded(welded->farthest_mm, 2) +
                               " mm apart were joined, which closes its surface");
    return true;
  }

  // Fills holes, whose borders must be rings that do not touch each other.
  bool fill_holes() {
    const auto borders = borders_of_holes();
    if (!borders) return false;
    formats::PolygonCutter cutter;
    for (const std::vector<uint32_t>& border : *borders) {
      std::vector<Vec3> corners;
      for (const uint32_t n : border) corners.push_back(mesh_.points[n]);
      for (const auto& [a, b, c] : cutter.cut(corners)) mesh_.triangles.push_back({border[a], border[b], border[c]});
    }
    messages_.warning(where_, "the surface of " + what_ + " lacks " +
                                  (borders->size() == 1 ? "a face" : format_count(borders->size()) + " faces") +
                                  ", filled as flat as their edges allow");
    return true;
  }

 private:
  // Returns the borders such that triangles between their corners face as those around them; nothing if there are none
  // or if they touch.
  std::optional<std::vector<std::vector<uint32_t>>> borders_of_holes() const {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const Triangle& t : mesh_.triangles)
      for (size_t n = 0; n < 3; ++n)
        if (!edges.insert({t[n], t[(n + 1) % 3]}).second) return std::nullopt;
    std::map<uint32_t, uint32_t> next;
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from}) && !next.emplace(to, from).second) return std::nullopt;
    std::vector<std::vector<uint32_t>> borders;
    while (!next.empty()) {
      std::vector<uint32_t>& border = borders.emplace_back();
      for (auto at = next.begin(); at != next.end(); at = next.find(border.back())) {
        if (border.empty()) border.push_back(at->first);
        border.push_back(at->second);
        next.erase(at);
      }
      if (border.size() < 4 || border.front() != border.back()) return std::nullopt;
      border.pop_back();
    }
    return borders.empty() ? std::nullopt : std::optional(std::move(borders));
  }

  TriangleMesh& mesh_;
  const std::string& what_;
  const SourceRange& where_;
  Diagnostics& messages_;
};

TriangleMesh turned_outward(TriangleMesh mesh) {
  if (volume_of(mesh) < 0)
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

}  // namespace

std::optional<Solid> mended_solid(TriangleMesh mesh, const std::string& what, const SourceRange& where,
                                  Diagnostics& messages) {
  Mender mender(mesh, what, where, messages);
  const auto warn = [&](const std::string& remark) { messages.warning(where, what + ' ' + remark); };
  for (bool is_mended = false;; is_mended = true) {
    std::string remark;
    try {
      Solid solid(kernel().body(mesh, false, remark));
      if (!remark.empty()) warn(remark);
      return solid;
    } catch (const Error& error) {
      if (error.code() == Code::surface_crosses) {
        warn(
            "crosses itself; it stays as it is, and where it is combined with others, a point is inside if the surface "
            "winds around it");
        return Solid(turned_outward(std::move(mesh)), Flaw::crosses);
      }
      const bool is_open = error.code() == Code::surface_open;
      if (is_open && !is_mended && (mender.join_corners() || mender.fill_holes())) continue;
      if (is_open) {
        warn(
            "is open; it stays as it is, and cannot be combined with others: close its surface, and turn all faces so "
            "that "
            "they are clockwise when seen from outside");
        return Solid(std::move(mesh), Flaw::open);
      }
      messages.error(where, what + " cannot be used: " + error.what());
      return std::nullopt;
    }
  }
}

}  // namespace ombre::solids
