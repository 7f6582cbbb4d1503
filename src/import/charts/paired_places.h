// Places of two surfaces at equal shares of u and v.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/math/box_tree.h"
#include "import/charts/shell_prisms.h"

namespace ombre::importing {

// How shares of one surface's u and v become those of another.
struct Pairing {
  bool is_exchanged = false;                  // u runs along the other's v
  bool is_u_back = false, is_v_back = false;  // u, or v, runs against the other's direction

  Vec2 share(Vec2 of) const;
};

// All pairings, and the one with this name: "uv" or "vu" says along which of the other surface's directions u and v
// run,
// "_flip_u", "_flip_v" or "_flip_both" which of them run back.
std::vector<Pairing> all_pairings();
Pairing pairing_called(std::string_view name);

// The partners of places of a surface on another one.
class PairedPlaces {
 public:
  // `lengths` are the extents of both surfaces' places in mm. With the name "nearest" the pairing is that with the
  // least sum of squared ways from points of the patch to their partners. `other` must outlive this.
  PairedPlaces(const SurfacePatch& other, Vec2 lengths, Vec2 other_lengths, std::string_view name,
               const SurfacePatch& patch);

  Vec3 partner(Vec2 place) const { return found(pairing_, place).point; }
  // The greatest distance in mm of a patch's partner from the outline of the other surface, and a point whose partner
  // would lie farther away from it than a twentieth of its extents.
  double farthest_off() const { return farthest_off_; }
  std::optional<Vec3> without_partner() const { return without_partner_; }

 private:
  struct Found {
    Vec3 point;
    double off = 0;  // distance from the other surface in its plane, mm
  };
  Found found(const Pairing& pairing, Vec2 place) const;
  double squared_ways(const Pairing& pairing, const SurfacePatch& patch) const;

  const SurfacePatch& other_;
  Vec2 lengths_, other_lengths_;
  std::vector<Prism> flat_;  // its triangles in the plane of u and v
  BoxTree tree_;
  Pairing pairing_;
  double farthest_off_ = 0;
  std::optional<Vec3> without_partner_;
};

}  // namespace ombre::importing
