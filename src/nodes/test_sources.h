// Sources with simple values, which tests use instead of files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "design/source_loader.h"

namespace ombre::nodes::test {

using design::HeightImage;
using design::MeshPart;
using design::Reader;

// A ball with exact distances.
class BallSource : public program::FieldSource {
 public:
  std::string name() const override { return "ball"; }
  Hash content() const override { return {1, 2}; }
  Box bounds() const override { return Box::centered({4, 4, 4}); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "inside" ? 0 : channel_name == "distance" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    const double distance = length(p) - 4;
    return channel == 1 ? distance : distance <= 0 ? 1 : 0;
  }
};

// Polygons and paths, computed edge by edge.
class EdgeSource : public program::FieldSource {
 public:
  EdgeSource(Polygons polygons, bool turns) : polygons_(std::move(polygons)), turns_(turns) {}
  std::string name() const override { return "edges"; }
  Hash content() const override { return {3, 4}; }
  Box bounds() const override {
    Box box;
    for (const Vec2 p : polygons_.solid[0]) box = hull(box, Box{{p.x, p.y, -Box::inf}, {p.x, p.y, Box::inf}});
    return box;
  }
  int channel(std::string_view channel_name) const override {
    return channel_name == "inside" ? 0 : channel_name == "distance" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    const bool is_inside = winding(polygons_.solid, p) != 0 && winding(polygons_.holes, p) == 0;
    if (channel == 0) return is_inside ? 1 : 0;
    const double nearest = std::min(distance(polygons_.solid, p, is_inside), distance(polygons_.holes, p, is_inside));
    return is_inside ? -nearest : nearest;
  }

 private:
  template <class Visit>
  static void for_edges(const std::vector<Ring>& rings, const Visit& visit) {
    for (const Ring& ring : rings)
      for (size_t n = 0; n < ring.size(); ++n) visit(ring[n], ring[(n + 1) % ring.size()]);
  }
  // Computes the winding number from the angles under which edges are seen.
  static long winding(const std::vector<Ring>& rings, Vec3 p) {
    double turned = 0;
    for_edges(rings, [&](Vec2 a, Vec2 b) {
      const Vec2 from{a.x - p.x, a.y - p.y}, to{b.x - p.x, b.y - p.y};
      turned += std::atan2(cross(from, to), dot(from, to));
    });
    return std::lround(turned / 6.283185307179586);
  }
  double distance(const std::vector<Ring>& rings, Vec3 p, bool is_inside) const {
    double best = Box::inf;
    for_edges(rings, [&](Vec2 a, Vec2 b) {
      if (turns_ && is_inside && a.x == 0 && b.x == 0) return;
      const Vec2 way = b - a, from{p.x - a.x, p.y - a.y};
      const double t = std::clamp(dot(way, from) / dot(way, way), 0.0, 1.0);
      best = std::min(best, length(from - t * way));
    });
    return best;
  }

  Polygons polygons_;
  bool turns_;
};

class PathSource : public program::FieldSource {
 public:
  explicit PathSource(std::vector<Vec3> points) : points_(std::move(points)) {}
  std::string name() const override { return "path"; }
  Hash content() const override { return {5, 6}; }
  Box bounds() const override {
    Box box;
    for (const Vec3& p : points_) box = hull(box, Box{p, p});
    return box;
  }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? 0 : channel_name == "along" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    double best = Box::inf, before = 0, at = 0;
    for (size_t n = 1; n < points_.size(); ++n) {
      const Vec3 way = points_[n] - points_[n - 1], from = p - points_[n - 1];
      const double t = std::clamp(dot(way, from) / dot(way, way), 0.0, 1.0);
      if (length(from - t * way) < best) at = before + t * length(way);
      best = std::min(best, length(from - t * way));
      before += length(way);
    }
    return channel == 0 ? best : at / before;
  }

 private:
  std::vector<Vec3> points_;
};

class PointsSource : public program::FieldSource {
 public:
  explicit PointsSource(std::vector<Vec3> points) : points_(std::move(points)) {}
  std::string name() const override { return "points"; }
  Hash content() const override { return {11, 12}; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? 0 : channel_name == "index" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    size_t best = 0;
    for (size_t n = 1; n < points_.size(); ++n)
      if (length(p - points_[n]) < length(p - points_[best])) best = n;
    return channel == 0 ? length(p - points_[best]) : static_cast<double>(best);
  }

 private:
  std::vector<Vec3> points_;
};

// A height image of waves.
class WaveSource : public program::FieldSource {
 public:
  std::string name() const override { return "waves"; }
  Hash content() const override { return {7, 8}; }
  Box bounds() const override { return {{0, 0, 0}, {20, 10, 0}}; }
  int channel(std::string_view channel_name) const override { return channel_name == "value" ? 0 : -1; }
  double sample(int, Vec3 p) const override { return 0.5 + 0.25 * (std::sin(p.x / 8) + std::sin(p.y / 4)); }
};

// A grid of 9 voxels along each axis, in index coordinates, with 110 in the middle and 10 less for each voxel away from
// it.
class HillSource : public program::FieldSource {
 public:
  std::string name() const override { return "hill"; }
  Hash content() const override { return {9, 10}; }
  Box bounds() const override { return {{-0.5, -0.5, -0.5}, {8.5, 8.5, 8.5}}; }
  int channel(std::string_view channel_name) const override {
    constexpr std::array<std::string_view, 6> names{"value", "nearest", "cubic", "cubic_x", "cubic_y", "cubic_z"};
    const auto found = std::find(names.begin(), names.end(), channel_name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  }
  double sample(int channel, Vec3 p) const override {
    constexpr int nearest = 1, first_slope = 3;
    if (channel == nearest) p = {std::floor(p.x + 0.5), std::floor(p.y + 0.5), std::floor(p.z + 0.5)};
    const Vec3 from_top = p - Vec3{4, 4, 4};
    const double away = length(from_top);
    if (channel >= first_slope) return away > 0 ? -10 * from_top[channel - first_slope] / away : 0;
    return 110 - 10 * away;
  }
};

// Voxels of the first colour around (4, 4, 4), with transparent ones around them.
class PixelSource : public HillSource {
 public:
  double sample(int, Vec3 p) const override { return HillSource::sample(1, p) > 80 ? 1 : 0; }
};

class PendingBall : public design::PendingSource {
 public:
  Hash content() const override { return source_->content(); }
  Box bounds() const override { return source_->bounds(); }
  program::SourceField make(const std::optional<design::JobScale>&) const override { return source_; }

 private:
  program::SourceField source_ = std::make_shared<BallSource>();
};

// The space above a square of 20 mm in the plane z = 0.
class SlabSource : public program::FieldSource {
 public:
  std::string name() const override { return "slab"; }
  Hash content() const override { return {13, 14}; }
  Box bounds() const override { return {{0, 0, 0}, {20, 20, 5}}; }
  int channel(std::string_view channel_name) const override {
    constexpr std::array<std::string_view, 15> names{"u",        "v",        "height",  "u_x",    "u_y",
                                                     "u_z",      "v_x",      "v_y",     "v_z",    "height_x",
                                                     "height_y", "height_z", "outside", "inside", "border"};
    const auto found = std::find(names.begin(), names.end(), channel_name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  }
  double sample(int channel, Vec3 p) const override {
    constexpr int first_slope = 3, outside = 12;
    if (channel < first_slope) return p[channel];
    if (channel < outside) return (channel - first_slope) % 4 == 0 ? 1 : 0;
    const double beside = std::max({-p.x, p.x - 20, -p.y, p.y - 20}), g = std::max({beside, -p.z, p.z - 5});
    return channel == outside ? g : channel == outside + 1 ? (g <= 0 ? 1 : 0) : std::abs(beside);
  }
};

// Places on the side z = 0 of a square of 20 mm from the origin on.
class SquarePlaces : public program::FieldSource {
 public:
  std::string name() const override { return "square"; }
  Hash content() const override { return {15, 16}; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    constexpr std::array<std::string_view, 10> names{"u", "v",        "distance", "x",        "y",
                                                     "z", "normal_x", "normal_y", "normal_z", "border"};
    const auto found = std::find(names.begin(), names.end(), channel_name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  }
  double sample(int channel, Vec3 p) const override {
    const Vec3 q{std::clamp(p.x, 0.0, 20.0), std::clamp(p.y, 0.0, 20.0), 0};
    const double numbers[] = {q.x, q.y, p.z < 0 ? -length(p - q) : length(p - q), q.x, q.y, 0, 0,
                              0,   1,   std::min({q.x, 20 - q.x, q.y, 20 - q.y})};
    return numbers[channel];
  }
};

// A stage of a ball, which is empty without a host of stages.
class BallStage : public design::SweepStage {
 public:
  std::string name() const override { return "ball"; }
  Hash content() const override { return {9, 10}; }
  Box bounds() const override { return Box::centered({4, 4, 4}); }
  std::vector<design::StageRead> reads() const override { return {}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"inside", {}, 0, true, {0, 1}}};
  }
  double bytes_of_column() const override { return 0; }
  std::unique_ptr<Sweep> begin(const design::StageLattice&, const IndexBox&, const design::StageWork&) const override {
    return nullptr;
  }
};

class BallLoader : public design::SourceLoader {
 public:
  design::StagePtr support(const design::NodePtr&, const design::SupportUse&, const Reader&) override {
    return std::make_shared<BallStage>();
  }

 protected:
  std::shared_ptr<const void> find(design::SourceRequest request, const Reader&) override {
    return std::visit([&](auto* kind) -> std::shared_ptr<const void> { return make(*kind); }, request);
  }
  virtual design::PendingSourcePtr pending() const { return std::make_shared<PendingBall>(); }

 private:
  using CadParts = std::vector<design::CadPart>;
  using MeshParts = std::vector<MeshPart>;

  std::shared_ptr<const CadParts> make(const design::CadRequest& request) const {
    CadParts parts{{"", pending()}};
    if (request.use.materials != "one") parts.push_back({"clear", parts[0].source});
    return std::make_shared<CadParts>(std::move(parts));
  }
  static std::shared_ptr<const MeshParts> make(const design::MeshRequest& request) {
    MeshParts parts{{"", std::make_shared<BallSource>()}};
    if (request.use.materials != "one") parts.push_back({"clear", std::make_shared<BallSource>()});
    return std::make_shared<MeshParts>(std::move(parts));
  }
  static std::shared_ptr<const MeshParts> make(const design::SolidsRequest&) {
    return std::make_shared<MeshParts>(MeshParts{{"", std::make_shared<BallSource>()}});
  }
  static std::shared_ptr<const design::ScadSolids> make(const design::ScadRequest&) {
    return std::make_shared<design::ScadSolids>(
        design::ScadSolids{{{"", std::make_shared<BallSource>()}, {"clear", std::make_shared<BallSource>()}}, {""}});
  }
  static program::SourceField make(const design::PolygonsRequest& request) {
    return std::make_shared<EdgeSource>(request.polygons, request.turns);
  }
  static program::SourceField make(const design::PathRequest& request) {
    if (request.kind != design::PathKind::path) return std::make_shared<PointsSource>(request.points);
    return std::make_shared<PathSource>(request.points);
  }
  static program::SourceField make(const design::GeodesicRequest& request) {
    return std::make_shared<PointsSource>(request.from);
  }
  static std::shared_ptr<const design::ImagePixels> make(const design::PixelsRequest&) {
    auto pixels = std::make_shared<design::ImagePixels>(design::ImagePixels{2, 2, {}});
    for (const int level : {0, 80, 160, 255})
      for (const int channel : {level, 255 - level, 40, 255}) pixels->rgba.push_back(static_cast<uint8_t>(channel));
    return pixels;
  }
  static std::shared_ptr<const std::vector<std::vector<double>>> make(const design::TableRequest&) {
    return std::make_shared<std::vector<std::vector<double>>>(
        std::vector<std::vector<double>>{{-5, 1}, {0, 2}, {5, 1.5}});
  }
  static program::SourceField make(const design::SurfaceColoursRequest&) {
    class Colours final : public PixelSource {
      int channel(std::string_view channel_name) const override {
        constexpr std::array<std::string_view, 4> names{"red", "green", "blue", "alpha"};
        const auto* const found = std::ranges::find(names, channel_name);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
      }
    };
    return std::make_shared<Colours>();
  }
  // Random designs name two materials, which is one ink and the rest. The example of a profile has three inks.
  static std::shared_ptr<const design::InkShares> make(const design::InkRequest& request) {
    const size_t inks = request.profile.path.ends_with(".icc") ? 3 : 1;
    design::InkShares shares{inks, "CMY", std::vector<std::vector<double>>(inks + 1), 1, 0, 0};
    for (size_t corner = 0; corner < 8; ++corner) {
      for (size_t ink = 0; ink < inks; ++ink) shares.values[ink].push_back((corner >> (2 - ink)) % 2 == 0 ? 0.25 : 0);
      shares.values[inks].push_back(2);
    }
    return std::make_shared<design::InkShares>(std::move(shares));
  }
  static std::shared_ptr<const HeightImage> make(const design::ImageRequest&) {
    return std::make_shared<HeightImage>(HeightImage{std::make_shared<WaveSource>(), 20, 10, 0.25 / 8, 0.25 / 4});
  }
  static std::shared_ptr<const design::VolumeGrid> make(const design::VolumeRequest&) {
    auto grid = std::make_shared<design::VolumeGrid>();
    grid->source = std::make_shared<HillSource>();
    grid->space_from_index = Affine::scaling({0.5, 0.5, 1});
    grid->places = [box = grid->source->bounds()](int, Interval) { return box; };
    return grid;
  }
  static std::shared_ptr<const design::ColourGrid> make(const design::ImageStackRequest&) {
    auto pixels = std::make_shared<design::ColourGrid>();
    pixels->grid.source = std::make_shared<PixelSource>();
    pixels->grid.space_from_index = Affine{};
    pixels->grid.places = [box = pixels->grid.source->bounds()](int, Interval) { return box; };
    pixels->colours = {{255, 0, 0, 255}};
    return pixels;
  }
  static std::shared_ptr<const design::ResultNumbers> make(const design::ResultsRequest&) {
    return std::make_shared<design::ResultNumbers>(
        design::ResultNumbers{std::make_shared<BallSource>(), "distance", "mm", {1}});
  }
  static std::vector<std::array<Vec2, 2>> slab_border() {
    return {{{{0, 0}, {20, 0}}}, {{{20, 0}, {20, 20}}}, {{{20, 20}, {0, 20}}}, {{{0, 20}, {0, 0}}}};
  }
  static std::shared_ptr<const design::SurfaceSpace> make(const design::SurfaceRequest&) {
    return std::make_shared<design::SurfaceSpace>(
        design::SurfaceSpace{std::make_shared<SlabSource>(), {20, 20}, {0, 5}, 5, {1, 1}, {1, 1}, 1, slab_border()});
  }
  static std::shared_ptr<const design::SurfacePlaces> make(const design::SurfacePlacesRequest&) {
    return std::make_shared<design::SurfacePlaces>(
        design::SurfacePlaces{std::make_shared<SquarePlaces>(), {20, 20}, {1, 1}});
  }
  static program::SourceField make(const design::TextRequest& request) {
    const double h = request.height_mm;
    return std::make_shared<EdgeSource>(Polygons{{{{0, 0}, {h, 0}, {h / 3, h / 3}, {0, h}}}, {}}, false);
  }
};

}  // namespace ombre::nodes::test
