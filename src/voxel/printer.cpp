// Reads printer profiles.
#include "voxel/printer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text/json.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "voxel/image_kinds.h"

namespace ombre::voxel {
namespace {

constexpr std::string_view material_place = "{material}";

void read_dpi(std::optional<Pitch>& pitch, const Data& data, const MemberReader&) {
  if (const double* dpi = data.number()) pitch = Pitch::from_dpi(format_number(*dpi));
}

std::optional<Pitch> read_pitch(const Data& data, const MemberReader& reader) {
  static const Record<std::optional<Pitch>> object("a pitch", {field::special("dpi", read_dpi).required()});
  std::optional<Pitch> pitch;
  if (const std::string* text = data.string()) pitch = Pitch::parse(*text);
  if (const double* mm = data.number()) pitch = Pitch::from_mm(*mm);
  if (data.members() && !object.read(data, pitch, reader)) return std::nullopt;
  // Coarser or finer than any machine is a slip of the unit.
  if (pitch && pitch->mm() >= 1e-5 && pitch->mm() <= 100) return pitch;
  reader.fail(data, "this is not a pitch: " + describe(data),
              R"(write mm as exact text, such as "25.4/600" or "0.027", or {"dpi": 600})");
  return std::nullopt;
}

Record<std::array<Pitch, 3>> pitch_record() {
  using Pitches = std::array<Pitch, 3>;
  const auto of_axis = [](size_t axis) {
    return Field<Pitches>(std::string(1, "xyz"[axis]),
                          [axis](Pitches& all, const Data& data, const MemberReader& r) {
                            all[axis] = read_pitch(data, r).value_or(Pitch());
                          })
        .required();
  };
  return Record<Pitches>("\"pitch\"", {of_axis(0), of_axis(1), of_axis(2)});
}

void read_flip(ImageLayout& layout, const Data& data, const MemberReader& reader) {
  const DataList* const list = data.list();
  if (!list) return reader.fail_expected(data, R"(a list of axes, such as ["y"])");
  for (const Data& axis : *list) {
    const std::string name = axis.string() ? *axis.string() : "";
    if (name != "x" && name != "y")
      reader.fail_expected(axis, R"("x" or "y")", "layers always count from the lowest");
    else
      (name == "x" ? layout.flip_x : layout.flip_y) = true;
  }
}

std::optional<NamePattern> read_pattern(const Data& data, const MemberReader& reader) {
  const auto pattern = data.string() ? NamePattern::parse(*data.string()) : std::nullopt;
  if (!pattern)
    reader.fail(data, "this is not a pattern for file names: " + describe(data),
                R"(write for example "slice_{index:05}.png", which gives slice_00000.png, or )"
                R"("slice_{index:05}_{material}.png" for a file of each material)");
  return pattern;
}

Record<SmallestFeature> feature_record() {
  using F = SmallestFeature;
  return Record<F>("\"smallest_feature\"", {field::number("distorts_mm", &F::distorts_mm, above_zero).required(),
                                            field::number("fails_mm", &F::fails_mm, above_zero).required()})
      .checked([](F& feature, const Data& data, const MemberReader& reader) {
        if (feature.fails_mm > feature.distorts_mm)
          reader.fail(*data.find("fails_mm"), "\"fails_mm\" must not be above \"distorts_mm\"");
      });
}

Record<ForbiddenNeighbour> neighbour_record() {
  using N = ForbiddenNeighbour;
  return Record<N>("a forbidden neighbour",
                   {field::text("material", &N::material).required(), field::text("near", &N::near).required(),
                    field::number("within_mm", &N::within_mm, above_zero).required()});
}

void read_texts(std::vector<std::string>& texts, const std::string& name, const Data& data,
                const MemberReader& reader) {
  const DataList* const list = reader.list(data, name);
  if (!list) return;
  texts.clear();
  for (const Data& item : *list)
    if (auto text = reader.text(item, name)) texts.push_back(std::move(*text));
}

void read_calibrations(Printer& printer, const Data& data, const MemberReader& reader) {
  read_texts(printer.calibrations, "calibrations", data, reader);
}

void read_needs(Printer& printer, const Data& data, const MemberReader& reader) {
  read_texts(printer.needs, "needs", data, reader);
  if (data.list() && data.list()->empty()) reader.fail(data, "a printer needs something", R"(write ["fractions"])");
}

void read_steps(Printer& printer, const Data& data, const MemberReader& reader) {
  const DataMembers* const steps = reader.named(data, "\"steps\"");
  if (!steps) return;
  for (const auto& [name, size] : *steps)
    if (const auto number = reader.number(size, name, above_zero)) printer.steps.push_back({name, *number});
}

// Steps are of what the machine needs, and those of fractions share out the whole.
void check_steps(const Printer& printer, const Data& data, const MemberReader& reader) {
  for (const ValueStep& step : printer.steps) {
    const Data& at = *data.find("steps");
    if (std::ranges::find(printer.needs, step.of) == printer.needs.end())
      reader.fail(at, "\"steps\" has " + step.of + ", which is not among the \"needs\"",
                  "the machine needs " + join(printer.needs, " and "));
    const double count = 1 / step.size;
    if (step.of == "fractions" && std::abs(count - std::round(count)) > 1e-9 * count)
      reader.fail(at, "1 is no multiple of " + format_number(step.size) + ", the step of fractions",
                  "write for example 0.25");
  }
}

const Record<Printer>& printer_record() {
  using P = Printer;
  static const Record<P> record =
      Record<P>(
          "a printer profile",
          {field::plain_name("a printer", &P::name),
           field::text("title", &P::title).required().means("the machine"),
           field::text("source", &P::source).required().means("where the figures come from"),
           field::object("pitch", &P::pitch, pitch_record())
               .required()
               .means(
                   R"(`{"x": P, "y": P, "z": P}`, where `z` is the layer height. `P` is a length in mm as exact text )"
                   R"((`"25.4/600"`, `"0.027"`), a number of mm, or `{"dpi": 600}`. Write resolutions as dpi: 600 dpi )"
                   R"(rounded to 0.0423 mm drifts 0.39 mm across a large tray)"),
           field::numbers("build_mm", &P::build_mm, "[x, y, z] in mm", above_zero)
               .means("`[x, y, z]`, the largest part; leave it out where there is no limit"),
           field::choice("image", &P::format, image_format_names())
               .required()
               .means("the kind of images, unless the job chooses another one"),
           field::choice("origin", &P::origin, placement_names())
               .means(
                   R"(`"design"` (default): images cover the design's own box; `"center"`: they cover the build plate )"
                   R"(with the part in its middle, which needs `build_mm`)"),
           field::special("flip", read_flip)
               .means(
                   R"(axes that the images run backwards on, such as `["y"]` (default `[]`). Unflipped, x grows to the )"
                   R"(right and the top row of pixels has the greatest y)"),
           field::numbers("background", &P::background, "[r, g, b, a], each 0 to 255", {0, 255, true})
               .means("`[r, g, b, a]` of void (default `[0, 0, 0, 0]`, transparent)"),
           field::value("files", &P::files, read_pattern)
               .means(
                   R"(file names with the layer's number (default `"slice_{index:05}.png"`, five digits with leading )"
                   R"(zeros). With `{material}` too, as in `"slice_{index:05}_{material}.png"`, each layer has one file )"
                   R"(for each of the job's materials, in which the others are void; an image of a value (`--by`) has )"
                   R"(the value's name there. Masks of materials always have: `_{material}` is added where it is )"
                   R"(missing)"),
           field::whole("first_index", &P::first_index, 0, 1'000'000'000)
               .means("the number of the lowest layer (default 0)"),
           field::choice("empty_layers", &P::drop_empty_layers, {"keep", "drop"})
               .means(
                   R"(`"keep"` (default) or `"drop"`. Dropped layers leave their numbers unused; `job.json` says which )"
                   R"(layer is the first with material)"),
           field::object("exposure", &P::exposure, exposure_record())
               .means(
                   R"(`{"seconds": 8, "first_seconds": 35, "fade_layers": 10}`: light for a layer and for the first )"
                   R"(one, and how many layers lie between them, for `.sl1` archives; with `"irradiance": 2.5`, that )"
                   R"(of white in mW/cm2, layers of doses get the time that gives white its dose)"),
           field::object("vats", &P::vats, vats_record())
               .means(R"(`{"wash_seconds": 30}`: a vat for each material, which take turns within a layer, and how )"
                      R"(long the part is washed between them; `job.json` lists the vats. It needs `{material}` in )"
                      R"(`files`)"),
           field::whole("max_materials", &P::max_materials, 1, 255)
               .means("the most materials in one job, 1 to 255, void not counted"),
           field::object("smallest_feature", &P::smallest_feature, feature_record())
               .means(R"(`{"distorts_mm": 0.42, "fails_mm": 0.21}`: details thinner than this distort, or fail)"),
           field::objects("forbidden_neighbours", &P::forbidden_neighbours, neighbour_record())
               .means(R"(`[{"material": "liquid", "near": "surface", "within_mm": 0.3}]`: the material must keep this )"
                      R"(distance from the surface, or from the material named in `near`)"),
           field::number("overhang_degrees", &P::overhang_degrees, {1, 89})
               .means("for a process that builds each layer on the one below: how far layers may hang over, in degrees "
                      "from the vertical; `ombre check` finds what hangs over more, and islands"),
           field::number("gap_mm", &P::gap_mm, {0, 1000})
               .means("the distance that `ombre tray` keeps between parts (default 2)"),
           field::flag("vat", &P::is_vat)
               .means("`true` if layers are made in a bath of resin: `ombre check` finds cups that hold it"),
           field::special("calibrations", read_calibrations)
               .means(R"(names or paths of [calibrations](../user/properties.md) that hold for the machine)"),
           field::special("needs", read_needs)
               .means(
                   R"(what the machine must know at each point of a part, into which [properties](../user/properties.md) )"
                   R"(are resolved: `["fractions"]` of materials (default), or names of attributes, such as )"
                   R"(`["temperature", "flow_rate"]`)"),
           field::special("steps", read_steps)
               .means(
                   R"(`{"infill_density": 5}`: the machine takes whole multiples of this step, to which values are )"
                   R"(rounded when [properties](../user/properties.md) are resolved; a step of `fractions` divides 1)")})
          .checked([](P& printer, const Data& data, const MemberReader& reader) {
            if (printer.origin == Placement::center && !printer.build_mm)
              reader.fail(data, R"("origin": "center" needs "build_mm", the plate to centre on)");
            check_steps(printer, data, reader);
            if (printer.vats && !printer.files.has_material())
              reader.fail(*data.find("vats"), "vats have an image each, and \"files\" has no {material}",
                          R"(write for example "files": "slice_{index:05}_{material}.png")");
          });
  return record;
}

}  // namespace

Record<Exposure> exposure_record() {
  using E = Exposure;
  return Record<E>("\"exposure\"", {field::number("seconds", &E::seconds, above_zero).required(),
                                    field::number("first_seconds", &E::first_seconds, above_zero).required(),
                                    field::whole("fade_layers", &E::fade_layers, 0, 1000),
                                    field::number("irradiance", &E::irradiance, above_zero)});
}

Record<Vats> vats_record() {
  return Record<Vats>("\"vats\"", {field::number("wash_seconds", &Vats::wash_seconds, {0, 86400}).required()});
}

const std::vector<std::string>& placement_names() {
  static const std::vector<std::string> names{"design", "center"};
  return names;
}

std::optional<NamePattern> NamePattern::parse(std::string_view text) {
  const size_t open = text.find("{index");
  const size_t close = open == std::string_view::npos ? open : text.find('}', open);
  if (close == std::string_view::npos) return std::nullopt;
  NamePattern pattern;
  pattern.before_ = text.substr(0, open);
  pattern.after_ = text.substr(close + 1);
  const std::string_view digits = text.substr(open + 6, close - open - 6);  // "" or ":05"
  if (digits.empty())
    pattern.digits_ = 1;
  else if (digits.size() == 3 && digits.substr(0, 2) == ":0" && digits[2] >= '1' && digits[2] <= '9')
    pattern.digits_ = digits[2] - '0';
  else
    return std::nullopt;

  return pattern.is_sound() ? std::optional(pattern) : std::nullopt;
}

bool NamePattern::is_sound() const {
  const std::string rest = of_material("").before_ + of_material("").after_;
  // Allows only characters that every file system accepts; no folders or hidden files.
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  if (!std::all_of(rest.begin(), rest.end(), allowed) || rest.size() > 100) return false;
  if (before_.starts_with('.') || !after_.ends_with(".png")) return false;

  // The text between number and material must contain more than digits, so that each name belongs to one layer only.
  const size_t in_before = before_.find(material_place), in_after = after_.find(material_place);
  const auto separates = [](std::string_view between) {
    return between.find_first_not_of("0123456789") != std::string_view::npos;
  };
  if (in_before != std::string::npos)
    return separates(std::string_view(before_).substr(in_before + material_place.size()));
  return in_after == std::string::npos || separates(std::string_view(after_).substr(0, in_after));
}

bool NamePattern::has_material() const {
  return before_.find(material_place) != std::string::npos || after_.find(material_place) != std::string::npos;
}

NamePattern NamePattern::with_material() const {
  NamePattern pattern = *this;
  if (!has_material()) pattern.after_.insert(after_.size() - std::string_view(".png").size(), "_{material}");
  return pattern;
}

NamePattern NamePattern::of_material(std::string_view material) const {
  NamePattern pattern = *this;
  for (std::string* side : {&pattern.before_, &pattern.after_}) {
    const size_t place = side->find(material_place);
    if (place == std::string::npos) continue;
    side->replace(place, material_place.size(), material);
    break;
  }
  return pattern;
}

std::string NamePattern::name(int64_t index) const {
  std::string digits = std::to_string(index);
  if (digits.size() < static_cast<size_t>(digits_)) digits.insert(0, static_cast<size_t>(digits_) - digits.size(), '0');
  return before_ + digits + after_;
}

std::optional<int64_t> NamePattern::index(std::string_view name) const {
  if (name.size() <= before_.size() + after_.size()) return std::nullopt;
  int64_t value = 0;
  const char* end = name.data() + name.size() - after_.size();
  const auto [stop, status] = std::from_chars(name.data() + before_.size(), end, value);
  if (status != std::errc() || stop != end || value < 0 || this->name(value) != name) return std::nullopt;
  return value;
}

std::string NamePattern::text() const {
  return before_ + (digits_ == 1 ? "{index}" : "{index:0" + std::to_string(digits_) + "}") + after_;
}

const std::vector<MemberInfo>& printer_members() { return printer_record().members(); }

std::optional<Printer> parse_printer(const SourcePtr& source, Diagnostics& diagnostics) {
  const std::optional<Data> root = parse_json(source, diagnostics);
  Printer printer;
  if (!root || !printer_record().read(*root, printer, MemberReader(diagnostics))) return std::nullopt;
  return printer;
}

}  // namespace ombre::voxel
