// Reads printer profiles.
#include "voxel/printer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::voxel {
namespace {

// The members of one object. Members that are never read are reported as unknown.
class Members {
 public:
  Members(const Data& object, Diagnostics& diagnostics, std::string what)
      : object_(object), diagnostics_(diagnostics), what_(std::move(what)) {
    if (!object.members()) diagnostics.error(object.where, what_ + " must be an object, not " + describe(object));
  }

  const Data* optional(const std::string& key) {
    known_keys_.push_back(key);
    return object_.find(key);
  }

  const Data* required(const std::string& key) {
    const Data* member = optional(key);
    if (!member && object_.members()) diagnostics_.error(object_.where, what_ + " has no \"" + key + '"');
    return member;
  }

  void report_unknown() const {
    if (!object_.members()) return;
    for (const auto& [key, member] : *object_.members()) {
      if (std::find(known_keys_.begin(), known_keys_.end(), key) != known_keys_.end()) continue;
      std::string hint = did_you_mean(key, known_keys_);
      if (hint.empty()) hint = "it may have " + join(known_keys_, ", ");
      diagnostics_.error(member.where, what_ + " has no member \"" + key + '"', std::move(hint));
    }
  }

 private:
  const Data& object_;
  Diagnostics& diagnostics_;
  std::string what_;
  std::vector<std::string> known_keys_;
};

// Reads values of a profile. Wrong values are reported and replaced by the default.
class ProfileReader {
 public:
  explicit ProfileReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Printer read(const Data& root) {
    Members members(root, diagnostics_, "a printer profile");
    Printer printer;
    read_name(members.required("name"), printer.name);
    read_text(members.required("title"), printer.title);
    read_text(members.required("source"), printer.source);
    if (const Data* pitch = members.required("pitch")) read_pitches(*pitch, printer.pitch);
    if (const Data* build = members.optional("build_mm")) read_build(*build, printer.build_mm);
    printer.format = static_cast<ImageFormat>(choice(members.required("image"), image_format_names()));
    printer.origin = static_cast<Placement>(choice(members.optional("origin"), placement_names()));
    if (const Data* flip = members.optional("flip")) read_flip(*flip, printer);
    if (const Data* background = members.optional("background")) read_colour(*background, printer.background);
    if (const Data* files = members.optional("files")) read_pattern(*files, printer.files);
    printer.first_index = integer(members.optional("first_index"), 0, 0, 1'000'000'000);
    printer.drop_empty_layers = choice(members.optional("empty_layers"), {"keep", "drop"}) == 1;
    printer.max_materials = static_cast<int>(integer(members.optional("max_materials"), 255, 1, 255));
    if (const Data* feature = members.optional("smallest_feature")) read_feature(*feature, printer.smallest_feature);
    if (const Data* list = members.optional("forbidden_neighbours"))
      read_neighbours(*list, printer.forbidden_neighbours);
    members.report_unknown();
    if (printer.origin == Placement::center && !printer.build_mm)
      diagnostics_.error(root.where, R"("origin": "center" needs "build_mm", the plate to centre on)");
    return printer;
  }

 private:
  void read_text(const Data* data, std::string& text) {
    if (!data) return;
    if (const std::string* s = data->string(); s && !trim(*s).empty())
      text = *s;
    else
      diagnostics_.error(data->where, "expected a text, not " + describe(*data));
  }

  void read_name(const Data* data, std::string& name) {
    if (!data) return;
    read_text(data, name);
    const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
    if (!std::all_of(name.begin(), name.end(), plain))
      diagnostics_.error(data->where, "a printer's name is made of lower-case letters, digits and '-'");
  }

  // Returns the index of the word in `choices`, or 0 (the default) if there is none.
  size_t choice(const Data* data, const std::vector<std::string>& choices) {
    if (!data) return 0;
    const std::string* text = data->string();
    const auto found = text ? std::find(choices.begin(), choices.end(), *text) : choices.end();
    if (found != choices.end()) return static_cast<size_t>(found - choices.begin());
    diagnostics_.error(data->where, "expected \"" + join(choices, "\" or \"") + "\", not " + describe(*data),
                       text ? did_you_mean(*text, choices) : "");
    return 0;
  }

  int64_t integer(const Data* data, int64_t otherwise, int64_t least, int64_t most) {
    if (!data) return otherwise;
    const double* number = data->number();
    if (number && *number == std::floor(*number) && *number >= static_cast<double>(least) &&
        *number <= static_cast<double>(most))
      return static_cast<int64_t>(*number);
    diagnostics_.error(data->where, "expected a whole number from " + std::to_string(least) + " to " +
                                        std::to_string(most) + ", not " + describe(*data));
    return otherwise;
  }

  double length_mm(const Data* data) {
    if (!data) return 0;
    if (const double* number = data->number(); number && std::isfinite(*number) && *number > 0) return *number;
    diagnostics_.error(data->where, "expected a length in mm above 0, not " + describe(*data));
    return 0;
  }

  void read_pitches(const Data& data, std::array<Pitch, 3>& pitch) {
    Members members(data, diagnostics_, "\"pitch\"");
    for (int axis = 0; axis < 3; ++axis)
      if (const Data* one = members.required(std::string(1, "xyz"[axis]))) read_pitch(*one, pitch[axis]);
    members.report_unknown();
  }

  void read_pitch(const Data& data, Pitch& pitch) {
    std::optional<Pitch> read;
    if (const std::string* text = data.string()) read = Pitch::parse(*text);
    if (const double* mm = data.number()) read = Pitch::from_mm(*mm);
    if (data.members()) {
      Members members(data, diagnostics_, "a pitch");
      const Data* dpi = members.required("dpi");
      members.report_unknown();
      if (!dpi) return;
      if (const double* number = dpi->number()) read = Pitch::from_dpi(format_number(*number));
    }
    // No machine has such a pitch, so the unit must be wrong.
    if (read && read->mm() >= 1e-5 && read->mm() <= 100)
      pitch = *read;
    else
      diagnostics_.error(data.where, "this is not a pitch: " + describe(data),
                         R"(write mm as exact text, such as "25.4/600" or "0.027", or {"dpi": 600})");
  }

  void read_build(const Data& data, std::optional<Vec3>& build) {
    const DataList* list = data.list();
    if (!list || list->size() != 3) {
      diagnostics_.error(data.where, "expected the build box as [x, y, z] in mm, not " + describe(data));
      return;
    }
    build = Vec3{length_mm(&(*list)[0]), length_mm(&(*list)[1]), length_mm(&(*list)[2])};
  }

  void read_flip(const Data& data, Printer& printer) {
    const DataList* list = data.list();
    if (!list)
      return diagnostics_.error(data.where, R"(expected a list of axes, such as ["y"], not )" + describe(data));
    for (const Data& axis : *list) {
      const std::string* name = axis.string();
      if (name && *name == "x")
        printer.flip_x = true;
      else if (name && *name == "y")
        printer.flip_y = true;
      else
        diagnostics_.error(axis.where, "expected \"x\" or \"y\", not " + describe(axis),
                           "layers always count from the lowest");
    }
  }

  void read_colour(const Data& data, std::array<uint8_t, 4>& colour) {
    const DataList* list = data.list();
    if (!list || list->size() != 4)
      return diagnostics_.error(data.where, "expected a colour as [r, g, b, a], each 0 to 255, not " + describe(data));
    for (size_t i = 0; i < 4; ++i) colour[i] = static_cast<uint8_t>(integer(&(*list)[i], 0, 0, 255));
  }

  void read_pattern(const Data& data, NamePattern& files) {
    const auto pattern = data.string() ? NamePattern::parse(*data.string()) : std::nullopt;
    if (pattern)
      files = *pattern;
    else
      diagnostics_.error(data.where, "this is not a pattern for file names: " + describe(data),
                         R"(write for example "slice_{index:05}.png", which gives slice_00000.png, or )"
                         R"("slice_{index:05}_{material}.png" for a file of each material)");
  }

  void read_feature(const Data& data, std::optional<SmallestFeature>& feature) {
    Members members(data, diagnostics_, "\"smallest_feature\"");
    const Data* distorts = members.required("distorts_mm");
    const Data* fails = members.required("fails_mm");
    members.report_unknown();
    feature = SmallestFeature{length_mm(distorts), length_mm(fails)};
    if (distorts && fails && feature->fails_mm > feature->distorts_mm)
      diagnostics_.error(fails->where, "\"fails_mm\" must not be above \"distorts_mm\"");
  }

  void read_neighbours(const Data& data, std::vector<ForbiddenNeighbour>& neighbours) {
    const DataList* list = data.list();
    if (!list) return diagnostics_.error(data.where, "expected a list of objects, not " + describe(data));
    for (const Data& element : *list) {
      Members members(element, diagnostics_, "a forbidden neighbour");
      ForbiddenNeighbour neighbour;
      read_text(members.required("material"), neighbour.material);
      read_text(members.required("near"), neighbour.near);
      neighbour.within_mm = length_mm(members.required("within_mm"));
      members.report_unknown();
      neighbours.push_back(std::move(neighbour));
    }
  }

  Diagnostics& diagnostics_;
};

constexpr std::string_view material_place = "{material}";

}  // namespace

const std::vector<std::string>& image_format_names() {
  static const std::vector<std::string> names{"rgba", "indexed", "gray", "mask"};
  return names;
}

const std::vector<std::string>& placement_names() {
  static const std::vector<std::string> names{"design", "center"};
  return names;
}

std::optional<ImageFormat> image_format(std::string_view name) {
  const auto& names = image_format_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<ImageFormat>(found - names.begin());
}

const std::string& to_text(ImageFormat format) { return image_format_names()[static_cast<size_t>(format)]; }

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

std::optional<Printer> parse_printer(const SourcePtr& source, Diagnostics& diagnostics) {
  const size_t errors_before = diagnostics.error_count();
  const std::optional<Data> root = parse_json(source, diagnostics);
  if (!root) return std::nullopt;
  Printer printer = ProfileReader(diagnostics).read(*root);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return printer;
}

}  // namespace ombre::voxel
