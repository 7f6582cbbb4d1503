// Shells of decks as solid elements, by the thickness that *SHELL SECTION gives them.
//
// A node has one normal for the shells around it that lie nearly in one plane, and several where they meet at an angle.
// Source: CalculiX CrunchiX User's Manual, "Eight-node shell element (S8 and S8R)".
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/results/deck_part.h"

namespace ombre::formats {

// Returns the solid element that a shell of this type becomes; null for other types and for shells of 6 nodes.
std::optional<ElementKind> thick_shell_kind(std::string_view type);

// The shells of a part that have a thickness, as solid elements with points of their own.
class ThickShells {
 public:
  struct Solid {
    const DeckPart::Element* shell = nullptr;
    std::array<uint32_t, 20> points{};  // places in points(), as many as its kind has nodes
  };

  // Reports an error at the line of a shell without an area.
  explicit ThickShells(const DeckPart& part);

  const std::vector<Vec3>& points() const { return points_; }
  // Returns the numbers of the nodes that the points stand for.
  const std::vector<uint64_t>& nodes() const { return nodes_; }
  const std::vector<Solid>& solids() const { return solids_; }
  // Returns the number of shells without a thickness.
  uint64_t thin() const { return thin_; }

 private:
  std::vector<Vec3> points_;
  std::vector<uint64_t> nodes_;
  std::vector<Solid> solids_;
  uint64_t thin_ = 0;
};

}  // namespace ombre::formats
