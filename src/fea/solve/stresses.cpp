#include "fea/solve/stresses.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fea/model/element_points.h"
#include "fea/solve/brick_stiffness.h"
#include "fea/solve/cut_brick.h"
#include "fea/solve/own_matrices.h"
#include "fea/solve/strains.h"

namespace ombre::fea {
namespace {

// Stresses at up to eight points, and at the corners to which they are extrapolated.
struct ElementStresses {
  size_t points = 0, corners = 0;
  std::array<Tensor, 8> at_points{}, at_corners{};
};

void add(double factor, const Tensor& from, Tensor& to) {
  for (size_t n = 0; n < 6; ++n) to[n] += factor * from[n];
}

double along(const Box& box, const Cell& corner, int axis, double share) {
  const double middle = 0.5 * (box.lo[axis] + box.hi[axis]), half = 0.5 * (box.hi[axis] - box.lo[axis]);
  return middle + (corner[static_cast<size_t>(axis)] == 1 ? share : -share) * half;
}

// Computes stresses at the points of Gauss' rule in the box around the part inside, and extrapolates them linearly to
// its corners.
class BrickStresses {
 public:
  BrickStresses(const Bricks& bricks, const std::vector<double>& displacements)
      : bricks_(bricks), displacements_(displacements) {}

  // `is_own` is true if the brick has a matrix of its own, and so enhanced strains.
  ElementStresses of(size_t brick, const Moduli& moduli, bool is_own) {
    const Fill fill = bricks_.fill(brick);
    if (!place_ || place_->fill != fill || place_->is_own != is_own || place_->moduli.shear != moduli.shear ||
        place_->moduli.bulk != moduli.bulk)
      find_place(fill, moduli, is_own);
    BrickVector u{};
    for (size_t c = 0; c < 8; ++c)
      for (size_t axis = 0; axis < 3; ++axis)
        u[3 * c + axis] = displacements_[3 * size_t{bricks_.nodes[brick][c]} + axis];
    ElementStresses found{8, 8, {}, {}};
    std::array<Tensor, 8> strains{};
    double mean = 0;
    for (size_t p = 0; p < 8; ++p) {
      strains[p] = strain_of(bricks_.nodes[brick], place_->gradients[p], displacements_);
      if (place_->enhanced) add(1, place_->enhanced->at(u, place_->points[p]), strains[p]);
      mean += (strains[p][0] + strains[p][1] + strains[p][2]) / 8;
    }
    for (size_t p = 0; p < 8; ++p) {
      // The change of volume of a full brick is the mean.
      found.at_points[p] = stress_with(strains[p], is_own ? std::nullopt : std::optional(mean), moduli);
    }
    for (size_t c = 0; c < 8; ++c)
      for (size_t p = 0; p < 8; ++p) add(carried(c, p), found.at_points[p], found.at_corners[c]);
    return found;
  }

 private:
  struct Place {
    Fill fill = 0;
    Moduli moduli;
    bool is_own = false;
    std::array<Vec3, 8> points{};
    std::array<std::array<Vec3, 8>, 8> gradients{};
    std::optional<EnhancedStrains> enhanced;
  };

  static Tensor stress_with(const Tensor& strain, std::optional<double> dilation, const Moduli& moduli) {
    Tensor stress = stress_of(strain, moduli.shear, moduli.bulk);
    if (!dilation) return stress;
    const double own = strain[0] + strain[1] + strain[2];
    for (size_t n = 0; n < 3; ++n) stress[n] += moduli.bulk * (*dilation - own);
    return stress;
  }

  // Returns the weight of a point's value at a corner: along each axis the corners are sqrt(3) times as far from the
  // middle as the points.
  static double carried(size_t corner, size_t point) {
    double factor = 1;
    for (size_t axis = 0; axis < 3; ++axis)
      factor *= brick_corners[corner][axis] == brick_corners[point][axis] ? 0.5 * (1 + std::sqrt(3.0))
                                                                          : 0.5 * (1 - std::sqrt(3.0));
    return factor;
  }

  void find_place(Fill fill, const Moduli& moduli, bool is_own) {
    place_ = Place{};
    place_->fill = fill;
    place_->moduli = moduli;
    place_->is_own = is_own;
    const Box box = fill_box(fill);
    const double gauss = 1 / std::sqrt(3.0);
    for (size_t p = 0; p < 8; ++p) {
      for (int axis = 0; axis < 3; ++axis) place_->points[p][axis] = along(box, brick_corners[p], axis, gauss);
      place_->gradients[p] = shape_gradients(bricks_.size_mm, place_->points[p]);
    }
    if (is_own) place_->enhanced.emplace(bricks_.size_mm, fill, moduli.shear, moduli.bulk);
  }

  const Bricks& bricks_;
  const std::vector<double>& displacements_;
  std::optional<Place> place_;  // place of the last brick; the next is often alike
};

// Extrapolates the four points of a tetrahedron to its corners; a single point stands for all.
ElementStresses tetrahedron_stresses(const MeshView& mesh, size_t element, const Moduli& moduli,
                                     const std::vector<double>& displacements) {
  ElementPoints points;
  find_points(mesh, element, points);
  ElementStresses found{points.count, mesh.shape().nodes, {}, {}};
  for (size_t p = 0; p < points.count; ++p)
    found.at_points[p] =
        stress_of(strain_of(mesh.nodes(element), points.points[p].gradients, displacements), moduli.shear, moduli.bulk);
  return found;
}

// Extrapolates by barycentric coordinates: they are 1 at the corner, 0.585 at the nearest point, 0.138 at the others.
Tensor at_corner(const ElementStresses& element, size_t corner) {
  if (element.points == 1) return element.at_points[0];
  constexpr double near_corner = 0.58541019662496852, far_corner = 0.13819660112501051;
  constexpr double own = (1 - far_corner) / (near_corner - far_corner);
  Tensor value{};
  for (size_t p = 0; p < 4; ++p) add(p == corner ? own : (1 - own) / 3, element.at_points[p], value);
  return value;
}

Tensor at_node(const ElementStresses& element, size_t node) {
  if (element.points == 8) return element.at_corners[node];
  if (node < 4) return at_corner(element, node);
  constexpr std::array<std::array<size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  Tensor value{};
  for (const size_t corner : edges[node - 4]) add(0.5, at_corner(element, corner), value);
  return value;
}

// Sums for each pair of a node and a section.
class NodeMeans {
 public:
  NodeMeans(const ModelView& model) : model_(model) {
    const MeshView& mesh = model.mesh;
    for (size_t element = 0; element < mesh.count(); ++element)
      for (const uint32_t node : mesh.nodes(element)) pairs_.push_back(key(node, element));
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    sums_.resize(pairs_.size());
    volumes_.resize(pairs_.size());
  }

  void add_element(size_t element, const ElementStresses& stresses) {
    const auto nodes = model_.mesh.nodes(element);
    const double volume = model_.mesh.volume_mm3(element);
    for (size_t n = 0; n < nodes.size(); ++n) {
      const auto place = std::ranges::lower_bound(pairs_, key(nodes[n], element)) - pairs_.begin();
      add(volume, at_node(stresses, n), sums_[static_cast<size_t>(place)]);
      volumes_[static_cast<size_t>(place)] += volume;
    }
  }

  std::vector<Tensor> means() const {
    std::vector<Tensor> found(model_.mesh.node_count());
    std::vector<double> greatest(found.size(), -1);
    for (size_t n = 0; n < pairs_.size(); ++n) {
      Tensor mean{};
      add(1 / volumes_[n], sums_[n], mean);
      const auto node = static_cast<size_t>(pairs_[n] >> 16);
      if (von_mises(mean) <= greatest[node]) continue;
      greatest[node] = von_mises(mean);
      found[node] = mean;
    }
    return found;
  }

 private:
  uint64_t key(uint32_t node, size_t element) const { return uint64_t{node} << 16 | model_.section_of[element]; }

  const ModelView& model_;
  std::vector<uint64_t> pairs_;
  std::vector<Tensor> sums_;
  std::vector<double> volumes_;
};

}  // namespace

Stresses stresses_of(const ModelView& model, const Solution& solution) {
  const MeshView& mesh = model.mesh;
  std::vector<double> displacements;
  for (const Vec3 u : solution.displacement_mm)
    for (int axis = 0; axis < 3; ++axis) displacements.push_back(u[axis]);
  const Bricks* const bricks = mesh.bricks();
  std::optional<BrickStresses> of_bricks;
  std::vector<uint8_t> is_own;
  if (bricks) {
    of_bricks.emplace(*bricks, displacements);
    is_own = bricks_with_own_stiffness(*bricks);
  }
  Stresses found;
  NodeMeans means(model);
  for (size_t element = 0; element < mesh.count(); ++element) {
    const Elastic& elastic = model.elastic(element);
    const Moduli moduli = moduli_of(elastic.modulus_mpa, elastic.poissons_ratio);
    const ElementStresses here = bricks ? of_bricks->of(element, moduli, is_own[element] != 0)
                                        : tetrahedron_stresses(mesh, element, moduli, displacements);
    double greatest = 0;
    for (size_t p = 0; p < here.points; ++p) greatest = std::max(greatest, von_mises(here.at_points[p]));
    found.greatest_at_points_mpa.push_back(greatest);
    means.add_element(element, here);
  }
  found.at_nodes_mpa = means.means();
  return found;
}

}  // namespace ombre::fea
