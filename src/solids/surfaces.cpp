// Solids below a grid of heights.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "formats/containers/text_scanner.h"
#include "formats/images/png.h"
#include "solids/files.h"
#include "solids/kernel.h"

namespace ombre::solids {
namespace {

constexpr size_t most_heights = 4'000'000;

struct Heights {
  size_t columns = 0, rows = 0, missing = 0;
  std::vector<double> values;                              // row by row, the first at y = 0; missing ones are 0
  double least = std::numeric_limits<double>::infinity();  // of those that are given

  double at(size_t column, size_t row) const { return values[row * columns + column]; }
};

// Reads lines of numbers; "#" begins a comment. Shorter lines are filled with zeros.
Heights heights_of_text(const std::string& path, const std::string& bytes, Diagnostics& messages) {
  formats::TextScanner scanner(path, bytes, messages, {'#', false});
  std::vector<std::vector<double>> rows;
  Heights heights;
  size_t count = 0;
  while (!scanner.at_end()) {
    std::vector<double>& row = rows.emplace_back();
    while (!scanner.at_line_end()) {
      row.push_back(scanner.coordinate("a height"));
      heights.least = std::min(heights.least, row.back());
      if (++count > most_heights) scanner.fail_here("there are more than 4 million heights", "use a coarser grid");
    }
    heights.columns = std::max(heights.columns, row.size());
  }
  heights.rows = rows.size();
  if (heights.rows * heights.columns > most_heights)
    scanner.fail_here("the grid has more than 4 million places", "use a coarser grid");
  for (std::vector<double>& row : rows) {
    heights.missing += heights.columns - row.size();
    row.resize(heights.columns);
    heights.values.insert(heights.values.end(), row.begin(), row.end());
  }
  return heights;
}

// Reads heights from 0 for black to 100 for white. If inverted, they are those of OpenSCAD 2021.01: 100/255 - height.
Heights heights_of_picture(const std::string& path, const std::string& bytes, bool is_inverted) {
  const formats::PngImage image = formats::decode_png(bytes, path, most_heights);
  Heights heights{.columns = image.width, .rows = image.height, .values = {}};
  for (uint32_t row = image.height; row-- > 0;)
    for (uint32_t column = 0; column < image.width; ++column) {
      const formats::Rgba c = image.colour(column, row);
      const double level = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
      heights.values.push_back(100 * (is_inverted ? 1 - level : level) / 255);
      heights.least = std::min(heights.least, heights.values.back());
    }
  return heights;
}

// Builds the mesh: four triangles around the middle of each square of the grid, and one wall for each edge of the
// border.
class HeightMesh {
 public:
  HeightMesh(const Heights& heights, bool is_centred) : heights_(heights) {
    if (is_centred)
      shift_ = {-0.5 * static_cast<double>(heights.columns - 1), -0.5 * static_cast<double>(heights.rows - 1)};
    // Like OpenSCAD, begins 1 mm below the least height, and at z = 0 if all heights are greater than 1 mm.
    foot_ = std::min(heights.least, 1.0) - 1;
  }

  TriangleMesh make() {
    for (size_t row = 0; row < heights_.rows; ++row)
      for (size_t column = 0; column < heights_.columns; ++column) add_point(column, row, heights_.at(column, row));
    for (size_t row = 0; row + 1 < heights_.rows; ++row)
      for (size_t column = 0; column + 1 < heights_.columns; ++column) add_square(column, row);
    add_walls();
    return std::move(mesh_);
  }

 private:
  uint32_t top(size_t column, size_t row) const { return static_cast<uint32_t>(row * heights_.columns + column); }

  uint32_t add_point(double x, double y, double z) {
    mesh_.points.push_back({x + shift_.x, y + shift_.y, z});
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }
  uint32_t add_point(size_t column, size_t row, double z) {
    return add_point(static_cast<double>(column), static_cast<double>(row), z);
  }

  void add_square(size_t column, size_t row) {
    const std::array<uint32_t, 4> corners{top(column, row), top(column + 1, row), top(column + 1, row + 1),
                                          top(column, row + 1)};
    double mean = 0;
    for (const uint32_t corner : corners) mean += mesh_.points[corner].z / 4;
    const uint32_t middle = add_point(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, mean);
    for (size_t n = 0; n < 4; ++n) mesh_.triangles.push_back({corners[n], corners[(n + 1) % 4], middle});
  }

  // Adds one polygon for each side and one below. Other solids often stand on the same plane, and intersections with
  // few triangles are faster. Heights that are missing may be at the foot; there the polygons meet.
  void add_walls() {
    const size_t columns = heights_.columns, rows = heights_.rows;
    std::array<std::vector<uint32_t>, 4> sides;  // counter-clockwise as seen from above
    for (size_t n = 0; n < columns; ++n) {
      sides[0].push_back(top(n, 0));
      sides[2].push_back(top(columns - 1 - n, rows - 1));
    }
    for (size_t n = 0; n < rows; ++n) {
      sides[1].push_back(top(columns - 1, n));
      sides[3].push_back(top(0, rows - 1 - n));
    }
    std::array<uint32_t, 4> feet{};
    for (size_t n = 0; n < 4; ++n) feet[n] = foot_below(sides[n].front());
    std::vector<uint32_t> rim;
    for (size_t n = 0; n < 4; ++n) add_side(sides[n], feet[n], feet[(n + 1) % 4], rim);
    std::ranges::reverse(rim);
    add_polygon(rim, [](const Vec3& p) { return Vec2{-p.x, p.y}; });
  }

  bool is_at_foot(uint32_t point) const { return mesh_.points[point].z <= foot_; }

  uint32_t foot_below(uint32_t point) {
    if (is_at_foot(point)) return point;
    const Vec3 p = mesh_.points[point];
    mesh_.points.push_back({p.x, p.y, foot_});
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }

  // Adds the walls below the points of a side, from one point at the foot to the next, which it also adds to the rim.
  void add_side(const std::vector<uint32_t>& side, uint32_t begin, uint32_t end, std::vector<uint32_t>& rim) {
    size_t from = 0;
    for (size_t n = 1; n < side.size(); ++n) {
      const bool is_last = n + 1 == side.size();
      if (!is_last && !is_at_foot(side[n])) continue;
      const uint32_t next = is_last ? end : side[n];
      std::vector<uint32_t> corners{begin, next};
      for (size_t above = n + 1; above-- > from;)
        if (side[above] != begin && side[above] != next) corners.push_back(side[above]);
      const Vec3 origin = mesh_.points[begin];
      if (corners.size() > 2)
        add_polygon(corners, [origin](const Vec3& p) {
          return Vec2{std::abs(p.x - origin.x) + std::abs(p.y - origin.y), p.z};
        });
      rim.push_back(begin);
      begin = next, from = n;
    }
  }

  // Adds the triangles of a polygon, which is counter-clockwise where `flat` maps it.
  template <class Flat>
  void add_polygon(const std::vector<uint32_t>& corners, const Flat& flat) {
    Ring ring;
    for (const uint32_t corner : corners) ring.push_back(flat(mesh_.points[corner]));
    for (const Triangle& t : kernel().triangulate(std::span(&ring, 1)).triangles)
      mesh_.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }

  const Heights& heights_;
  Vec2 shift_;
  double foot_ = 0;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh mesh_of(const Surface& surface, const SourceRange& where, Diagnostics& messages) {
  std::string bytes;
  try {
    bytes = formats::read_file(surface.path);
  } catch (const Error&) {
    messages.warning(where, "The file '" + surface.path + "' couldn't be opened.");
    return {};
  }
  const bool is_picture = ending_of(surface.path) == ".png";
  try {
    const Heights heights = is_picture ? heights_of_picture(surface.path, bytes, surface.inverted)
                                       : heights_of_text(surface.path, bytes, messages);
    if (heights.columns < 2 || heights.rows < 2) {
      messages.error(where, "surface needs at least two rows and two columns of heights");
      return {};
    }
    if (heights.missing > 0)
      messages.warning(where, format_count(heights.missing) + " heights are missing, since lines of '" + surface.path +
                                  "' are shorter than the longest; they are 0");
    return HeightMesh(heights, surface.centred).make();
  } catch (const DesignError&) {
    messages.note(where, "the surface is used here");
    return {};
  }
}

}  // namespace ombre::solids
