// Solids from images.
#include <algorithm>

#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Relief {
  FilePath path;
  double width = 40, height = 2, base = 1;
  MaterialName material;
  double length_y = 0;
  std::shared_ptr<const HeightImage> image;  // read when the node is made

  static Spec<Relief> spec() {
    return {
        "relief",
        "A plate that is higher where an image is brighter, centred on the z axis, with its foot on z = 0.",
        {{"path", &Relief::path,
          "A PNG or JPEG file, gray or in colours; only its brightness counts; relative to the script, then to the "
          "working "
          "directory",
          required()},
         {"width", &Relief::width, "Length along x", unit::positive_mm},
         {"height", &Relief::height, "Height of white above black", unit::positive_mm},
         {"base", &Relief::base, "Thickness below black", unit::positive_mm},
         {"material", &Relief::material, "Its material"},
         {"length", &Relief::length_y, "Length along y; 0: keeps the proportions of the image", unit::not_negative_mm}},
        no_inputs,
        "relief(\"models/leaf.png\", 30, 2, 1, \"green\");"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("images cannot be read here");
    ImageRequest request{path};
    image = reader.loader->source(request, reader);
    path = request.file;
    return image != nullptr;
  }

  // A steep slope is nearer than the difference in height.
  Metric metric() const { return Metric::bounded(); }

  Box reach(const Inputs&, const Box&, double margin) const {
    const double x = width / 2 + margin, y = length_mm() / 2 + margin;
    return {{-x, -y, -margin}, {x, y, base + height + margin * steepness() + 1e-9 * height}};
  }

  Field distance(const Point& p) const {
    const int channel = image->source->channel("value");
    ASSERT(channel >= 0);
    const Field column = (p.x + width / 2) * (image->columns / width);
    const Field row = (p.y + length_mm() / 2) * (image->rows / length_mm());
    const Field top = p.builder().source(image->source, channel, column, row, p.constant(0)) * height + base;
    const Field sides = max(abs(p.x) - width / 2, abs(p.y) - length_mm() / 2);
    return max(max(sides, -p.z), (p.z - top) * (1 / steepness()));
  }

 private:
  double length_mm() const { return length_y > 0 ? length_y : width * image->rows / image->columns; }
  // Returns the Lipschitz constant of z - top.
  double steepness() const {
    const double across = image->step_across * image->columns / width, up = image->step_up * image->rows / length_mm();
    return std::sqrt(1 + height * height * (across * across + up * up)) * (1 + 1e-12);
  }
};

}  // namespace

void add_relief(Registry& registry) { registry.add<Relief>("imported"); }

}  // namespace ombre::nodes
