// Smooth curves through points, with frames that move along them without turning around them.
#pragma once

#include <vector>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/math/box.h"
#include "design/spec.h"
#include "program/field_source.h"

namespace ombre::nodes {

// The rule says what a curve is like at its ends, and how its frames move.
struct CurveRule {
  enum class Ends : uint8_t { straight, cut, closed };  // continues straight, ends, or returns to the first point
  enum class Frame : uint8_t { parallel, frenet };
  Vec3 toward{0, 0, 1};  // the second normal at the start, as far as it is perpendicular to the curve
  Ends ends = Ends::straight;
  Frame frame = Frame::parallel;
};

// A cubic spline through points: natural, or periodic if it is closed. Frames are parallel transported (W. Wang and
// others, "Computation of rotation minimizing frames", ACM Transactions on Graphics 27, 2008); along a closed curve
// they also turn by the same angle for each mm, so that they meet at its start. The second normal of Frenet's frames
// points to the centre of curvature; where the curve is straight, they are those that are transported.
class CurveFrames final : public program::FieldSource {
 public:
  // The curve needs two points at least, or three if it is closed, each different from the one before.
  CurveFrames(std::vector<Vec3> points, const CurveRule& rule);

  // Limits ranges of channels to points at most this far from the curve, where the nearest point changes continuously.
  void set_reach(double mm) { reach_ = mm; }
  double length() const { return nodes_.back().along; }
  // Returns the angle by which frames turn around the curve, in radians for each mm.
  double turn() const { return turn_; }
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

  void make_sections(std::vector<Vec3> points);
  void make_nodes();
  void close_frames();
  void find_tightest();
  Moving at(double parameter, size_t section) const;
  double arc(double from, double to, size_t section) const;
  Vec3 moved_normal(const Node& from, Vec3 to, Vec3 tangent) const;
  double nearest_parameter(Vec3 p, size_t node) const;
  Place place(Vec3 p) const;
  Place place_near(Vec3 p, size_t node) const;
  Place place_beyond(Vec3 p, const Node& end) const;
  static Place framed(double s, Vec3 way, Vec3 tangent, Vec3 normal, double stretched, double away);

  std::vector<Section> sections_;
  std::vector<Node> nodes_;
  double least_radius_ = std::numeric_limits<double>::infinity();
  Vec3 tightest_;
  double reach_ = 0;
  double turn_ = 0;  // of a closed curve's frames, radians for each mm
  CurveRule rule_;
  Hash content_;
};

// Parameters of nodes along a curve.
struct CurveParameters {
  design::Points points;
  Vec3 toward{0, 0, 1};
  bool is_closed = false;
  std::shared_ptr<CurveFrames> curve;  // made with the node
};

// Returns a node's curve through 2 to 1000 points, or from 3 if it is closed, of which equal neighbours count once.
// Reports other numbers of points and returns null.
std::shared_ptr<CurveFrames> smooth_curve(const design::Points& points, const CurveRule& rule,
                                          const design::Reader& reader);

}  // namespace ombre::nodes
