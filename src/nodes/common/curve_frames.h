// Smooth curves through points, with frames that move along them without turning around them.
#pragma once

#include <vector>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "base/math/box.h"
#include "program/field_source.h"

namespace ombre::nodes {

// A natural cubic spline through points, which may continue straight beyond its ends. Frames are parallel transported
// (W. Wang and others, "Computation of rotation minimizing frames", ACM Transactions on Graphics 27, 2008).
class CurveFrames final : public program::FieldSource {
 public:
  // The curve needs two points at least, each different from the one before. The second normal is `toward` at the
  // start, as far as it is perpendicular to the curve.
  enum class Ends : uint8_t { straight, cut };
  CurveFrames(std::vector<Vec3> points, Vec3 toward, Ends ends = Ends::straight);

  // Limits ranges of channels to points at most this far from the curve, where the nearest point changes continuously.
  void set_reach(double mm) { reach_ = mm; }
  double length() const { return nodes_.back().along; }
  // Returns the least radius of curvature among sixteen points of each section, and that point.
  double least_radius() const { return least_radius_; }
  Vec3 tightest() const { return tightest_; }
  // Returns a point within `reach` of which the curve passes again, or nothing.
  std::optional<Vec3> near_itself(double reach) const;
  // Returns a box around the curve.
  Box box() const;

  // mm; the stretch of lengths along the curve; the tangent, and the direction of `second`.
  enum Channel {
    along,
    first,
    second,
    stretch,
    distance,
    tangent_x,
    tangent_y,
    tangent_z,
    normal_x,
    normal_y,
    normal_z,
    channel_count
  };

  std::string name() const override { return "curve"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override;
  double sample(int channel, Vec3 p) const override;
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override;
  Interval range(int channel, const Box& box) const override;
  double ops_of_sample(int) const override { return 100; }

 private:
  // A polynomial of the parameter from the start of the section, for each axis.
  struct Section {
    double begin = 0, width = 0;
    std::array<Vec3, 4> powers;
  };
  struct Moving {
    Vec3 at, speed, bend;  // position, and its derivatives by the parameter
    Vec3 tangent() const { return (1 / ombre::length(speed)) * speed; }
    Vec3 curvature() const;  // towards the centre of curvature, per mm
  };
  struct Node {
    double parameter = 0, along = 0;
    size_t section = 0;
    Vec3 at, tangent, normal;
  };
  using Place = std::array<double, channel_count>;

  void make_sections(const std::vector<Vec3>& points);
  void make_nodes(Vec3 toward);
  void find_tightest();
  Moving at(double parameter, size_t section) const;
  double arc(double from, double to, size_t section) const;
  Vec3 moved_normal(const Node& from, Vec3 to, Vec3 tangent) const;
  double nearest_parameter(Vec3 p, size_t node) const;
  Place place(Vec3 p) const;
  Place place_beyond(Vec3 p, const Node& end) const;
  static Place framed(double s, Vec3 way, Vec3 tangent, Vec3 normal, double stretched, double away);

  std::vector<Section> sections_;
  std::vector<Node> nodes_;
  double least_radius_ = std::numeric_limits<double>::infinity();
  Vec3 tightest_;
  double reach_ = 0;
  Ends ends_;
  Hash content_;
};

}  // namespace ombre::nodes
