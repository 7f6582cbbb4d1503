// Grids of numbers from files, as solids and values, and numbers as materials.
#include <algorithm>
#include <map>

#include "base/text/text.h"
#include "nodes/common/shapes.h"
#include "nodes/common/volume_place.h"

namespace ombre::nodes {
namespace {

using namespace design;

const char* channel_between(const Choice& between) {
  return between == "nearest" ? "nearest" : between == "cubic" ? "cubic" : "value";
}

struct VolumeSolid : VolumePlace {
  MaterialName material;
  double level = 0.5;
  std::optional<double> upper;
  int label = -1;
  std::string segment;
  bool above = true;
  Choice between = "linear", by = "level";

  static Spec<VolumeSolid> spec() {
    std::vector<Parameter<VolumeSolid>> parameters = with_place<VolumeSolid>(
        {{"material", &VolumeSolid::material, "Its material"},
         {"level", &VolumeSolid::level, "Value at the surface, which is the least one inside"},
         {"upper", &VolumeSolid::upper, "Greatest value inside"},
         {"label", &VolumeSolid::label,
          "Value of the voxels that are inside, without interpolation; -1: the level decides",
          from_to(-1, greatest_label)},
         {"above", &VolumeSolid::above, "Values above the level are inside; false: values below it"},
         {"between", &VolumeSolid::between, "Interpolation between the centres of voxels",
          one_of({"linear", "nearest", "cubic"})},
         {"by", &VolumeSolid::by, "Source of the level: level (as given), or otsu (Otsu's method)",
          one_of({"level", "otsu"})}});
    parameters.emplace_back("segment", &VolumeSolid::segment,
                            "Name or ID of a segment of a segmentation (.seg.nrrd, DICOM), in place of a label");
    return {"volume_solid",
            "The region of a grid of numbers (a scan, say) where the numbers reach a level or equal a label.",
            std::move(parameters), no_inputs, "volume_solid(\"models/two_lobes.nrrd\", \"red\", level=100);"};
  }

  bool complete(const Reader& reader) {
    if (!segment.empty() && !check_segment(reader)) return false;
    design::VolumeRequest wanted;
    wanted.segment = segment;
    wanted.label = label;
    wanted.are_labels = label >= 0;
    // Padding lies outside the solid.
    wanted.is_outside_high = !above;
    if (label >= 0) wanted.outside = label == 0 ? 1 : 0;
    if (!read_volume(reader, wanted)) return false;
    if (by == "otsu") level = grid->otsu_level;
    if (has_padding_inside()) {
      wanted.level = level;
      if (!read_volume(reader, wanted)) return false;
    }
    if (!upper || (above && *upper >= level)) return true;
    return reader.refuse(
        above ? "upper of volume_solid is below its level, so nothing is inside"
              : "upper of volume_solid goes with values above the level, not with above=false",
        "write for example " + spelled::parameter("level", "60") + ", " + spelled::parameter("upper", "200"));
  }

  Metric metric() const { return Metric::implicit(); }

  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box places = grid->places(channel(), wanted(margin));
    if (places.is_empty()) return places;
    const Box box = image(here_from_index, places.expanded(margin));
    return intersect(box.expanded(1e-9 * (length(box.size()) + length(here_from_index.offset))), where);
  }

  Field distance(const Point& p) const {
    const Point at = p.mapped(index_from_here);
    const Box cells = grid->source->bounds();
    const Vec3 c = cells.center(), h = 0.5 * cells.size();
    const Field from_grid = corner(abs(at.x - c.x) - h.x, abs(at.y - c.y) - h.y, abs(at.z - c.z) - h.z);
    const Field read = p.builder().source(grid->source, channel(), at.x, at.y, at.z);
    const bool has_number = number() >= 0;
    Field value = has_number ? abs(read - static_cast<double>(number())) - 0.5 : above ? level - read : read - level;
    if (!has_number && upper) value = program::max(value, read - *upper);
    return select(from_grid <= 0, value, program::max(value, from_grid));
  }

 private:
  bool check_segment(const Reader& reader) const {
    if (label < 0 && voxel_channel < 0) return true;
    return reader.refuse(
        std::string("a segment has a number of its own") + (label < 0 ? ", in a channel of its own" : ""),
        label < 0 ? "leave channel out" : "leave label out, or segment");
  }

  // Scans whose other numbers all lie inside are read again for this level, so that padding lies outside.
  bool has_padding_inside() const {
    if (number() >= 0 || !grid->padding) return false;
    return above ? *grid->padding >= level : *grid->padding <= level;
  }

  // Returns the number of the chosen label or segment, or a negative number if there is none.
  int64_t number() const { return segment.empty() ? label : segment_label; }

  static constexpr int greatest_label = (1 << 24) - 1;  // floats distinguish integers up to this one

  int channel() const { return VolumePlace::channel(number() >= 0 ? "nearest" : channel_between(between)); }

  // Returns the range of values where g is at most `margin`.
  Interval wanted(double margin) const {
    if (const auto wanted = static_cast<double>(number()); wanted >= 0)
      return {wanted - 0.5 - margin, wanted + 0.5 + margin};
    if (upper) return {level - margin, *upper + margin};
    return above ? Interval(level - margin, Box::inf) : Interval(-Box::inf, level + margin);
  }
};

struct Volume : VolumePlace {
  double outside = 0;
  bool clamp = false;
  Choice between = "linear";

  static Spec<Volume> spec() {
    return {"volume",
            "Numbers of a grid from a file (a scan, say), at the point where they are used.",
            with_place<Volume>({{"outside", &Volume::outside, "Value outside the grid"},
                                {"clamp", &Volume::clamp,
                                 "Continues the values at the grid's sides outside it, in place of `outside`"},
                                {"between", &Volume::between, "Interpolation of `value` between the centres of voxels",
                                 one_of({"linear", "nearest", "cubic"})}}),
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", volume(\"models/two_lobes.nrrd\").value / 200));",
            {{"value", &Volume::value, "The number, interpolated as `between` says"},
             {"nearest", &Volume::nearest, "The number of the voxel whose centre is nearest"},
             {"inside", &Volume::is_inside, "1 inside the grid, 0 outside", {0, 1}},
             {"gradient", &Volume::gradient,
              "Derivatives of the value along x, y and z, per mm: exact for cubic interpolation, else from differences "
              "over a voxel each way"}}};
  }

  bool complete(const Reader& reader) {
    design::VolumeRequest wanted;
    wanted.are_labels = between == "nearest";
    wanted.outside = outside;
    return read_volume(reader, wanted);
  }

  Field value(const Ask& ask) const { return read(ask, channel_between(between)); }
  Field nearest(const Ask& ask) const { return read(ask, "nearest"); }
  Field is_inside(const Ask& ask) const { return is_in_grid(ask.p.mapped(index_from_here)); }

  VectorField gradient(const Ask& ask) const {
    const Point at = ask.p.mapped(index_from_here);
    const auto along = [&](double x, double y, double z) {
      if (between == "cubic")
        return ask.p.builder().source(grid->source,
                                      channel(x > 0   ? "cubic_x"
                                              : y > 0 ? "cubic_y"
                                                      : "cubic_z"),
                                      at.x, at.y, at.z);
      const auto sample = [&](double side) {
        return ask.p.builder().source(grid->source, channel("value"), at.x + side * x, at.y + side * y,
                                      at.z + side * z);
      };
      return 0.5 * (sample(1) - sample(-1));
    };
    const Field i = along(1, 0, 0), j = along(0, 1, 0), k = along(0, 0, 1);
    const auto here = [&](int axis) {
      const auto& rows = index_from_here.rows;
      return i * rows[0][axis] + j * rows[1][axis] + k * rows[2][axis];
    };
    return {here(0), here(1), here(2)};
  }

 private:
  Field read(const Ask& ask, const char* name) const {
    const Point at = ask.p.mapped(index_from_here);
    const Field value = ask.p.builder().source(grid->source, channel(name), at.x, at.y, at.z);
    return clamp ? value : select(is_in_grid(at), value, ask.p.constant(outside));
  }

  Field is_in_grid(const Point& at) const {
    const Box cells = grid->source->bounds();
    const Vec3 c = cells.center(), h = 0.5 * cells.size();
    const auto within = [](Field from_middle, double half) {
      return less_equal(abs(from_middle), from_middle.builder->constant(half));
    };
    return logical_and(logical_and(within(at.x - c.x, h.x), within(at.y - c.y, h.y)), within(at.z - c.z, h.z));
  }
};

struct Transfer {
  Number value;
  std::vector<MaterialStop> stops;
  Choice mode = "linear";
  MaterialName otherwise;

  static Spec<Transfer> spec() {
    Spec<Transfer> spec{
        "transfer",
        "The material for a number: a transfer function for scans, or the materials of labels.",
        {{"value", &Transfer::value, "The number", required()},
         {"stops", &Transfer::stops, "Pairs of a number and a material, with numbers in ascending order", required()},
         {"mode", &Transfer::mode,
          "linear: mixtures of neighbouring stops; step: the last stop at or below the number; label: the stop with "
          "exactly that number",
          one_of({"linear", "step", "label"})},
         {"otherwise", &Transfer::otherwise,
          "Material of labels without a stop, and of numbers below the first step; none: void"}},
        no_inputs,
        "sphere(8, transfer(formula(\"x\"), [[-4, \"red\"], [0, \"clear\"], [4, \"blue\"]]));",
        {{"mixture", &Transfer::mixture, "The material or mixture for the number"}}};
    spec.parameters[3].fill = [](Transfer& node, const Reader& reader) {
      if (!node.otherwise.is_given()) node.otherwise.material = reader.materials.find("void");
    };
    return spec;
  }

  bool complete(const Reader& reader) const {
    if (stops.empty())
      return reader.refuse("transfer has no stops", "write for example [[0, \"clear\"], [100, \"red\"]]");
    for (size_t n = 1; n < stops.size(); ++n)
      if (!(stops[n - 1].at < stops[n].at))
        return reader.refuse("the stops of transfer are not in rising order: " + format_number(stops[n].at) +
                                 " follows " + format_number(stops[n - 1].at),
                             "sort them by their numbers");
    return true;
  }

  Composition mixture(const Ask& ask) const {
    const Field read = value(ask.p), usable = is_finite(read);
    std::map<MaterialId, Field> shares;
    const auto add = [&](const MaterialName& material, Field share) {
      Field& sum = shares.try_emplace(ask.in.material(material), share.builder->constant(0)).first->second;
      sum = sum + share;
    };
    Field rest = ask.p.constant(1);
    for (size_t n = 0; n < stops.size(); ++n) {
      const Field share = select(usable, share_of(n, read), ask.p.constant(0));
      add(stops[n].material, share);
      rest = rest - share;
    }
    if (mode != "linear" && otherwise.is_given()) add(otherwise, max(rest, 0.0));
    Composition result{{shares.begin(), shares.end()}, {}};
    if (ask.p.builder().constant_value(usable) != 1.0)
      result.checks.push_back(ask.in.check(logical_not(usable), "the value of transfer is not a finite number there"));
    return result;
  }

 private:
  Field share_of(size_t n, Field read) const {
    const double at = stops[n].at;
    const bool is_first = n == 0, is_last = n + 1 == stops.size();
    const auto from = [&](double edge) { return less_equal(read.builder->constant(edge), read); };
    const auto below = [&](double edge) { return less(read, read.builder->constant(edge)); };
    if (mode == "label") return less(abs(read - at), read.builder->constant(0.5));
    if (mode == "step") return is_last ? from(at) : logical_and(from(at), below(stops[n + 1].at));
    Field share = read.builder->constant(1);
    if (!is_first) {
      const double before = stops[n - 1].at;
      share = min(share, (read - before) * (1 / (at - before)));
    }
    if (!is_last) {
      const double next = stops[n + 1].at;
      share = min(share, (next - read) * (1 / (next - at)));
    }
    return max(share, 0.0);
  }
};

}  // namespace

void add_volumes(Registry& registry) {
  registry.add<VolumeSolid>("imported");
  registry.add<Volume, Transfer>("values");
}

}  // namespace ombre::nodes
