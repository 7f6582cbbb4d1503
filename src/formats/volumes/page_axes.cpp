#include "formats/volumes/page_axes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/volumes/volume_parts.h"
#ifdef OMBRE_3MF
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#endif

namespace ombre::formats {
namespace {

constexpr int64_t most_planes = 100'000;  // as many as pages of a TIFF file are read

// Returns the factor to mm of a unit of length, or nothing for other words, such as pixels.
std::optional<double> mm_of_unit(const std::string& unit) {
  static const std::map<std::string, double> units{
      {"mm", 1},       {"millimeter", 1},   {"millimetre", 1}, {"cm", 10},          {"centimeter", 10},
      {"m", 1000},     {"meter", 1000},     {"um", 1e-3},      {"\xC2\xB5m", 1e-3}, {"\xCE\xBCm", 1e-3},
      {"\xB5m", 1e-3}, {"\\u00b5m", 1e-3},  {"micron", 1e-3},  {"microns", 1e-3},   {"micrometer", 1e-3},
      {"nm", 1e-6},    {"nanometer", 1e-6}, {"pm", 1e-9},      {"\xC3\x85", 1e-7},  {"in", 25.4},
      {"inch", 25.4}};
  const auto found = units.find(to_lower(unit));
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

// The lines "name=value" that ImageJ writes.
class ImageJDescription {
 public:
  ImageJDescription(const std::string& path, const std::string& text) : path_(path) {
    for (const std::string& line : split(text, '\n'))
      if (const size_t equals = line.find('='); equals != std::string::npos)
        fields_[to_lower(std::string(trim(line.substr(0, equals))))] = std::string(trim(line.substr(equals + 1)));
  }

  PageAxes axes() const {
    PageAxes axes;
    axes.is_imagej = true;
    axes.channels = count("channels");
    axes.slices = count("slices");
    axes.frames = count("frames");
    const int64_t images = count("images");
    // Plain stacks give only the number of images.
    if (axes.count() == 1) axes.slices = images;
    if (axes.count() != images)
      fail_volume(path_, "has " + std::to_string(images) + " images, where its description gives " +
                             std::to_string(axes.channels) + " channels of " + std::to_string(axes.slices) +
                             " slices and " + std::to_string(axes.frames) + " frames");
    axes.unit_mm = mm_of_unit(field("unit"));
    if (const auto spacing = parse_number(field("spacing")); spacing && axes.unit_mm && *spacing != 0)
      axes.z_mm = std::abs(*spacing) * *axes.unit_mm;
    return axes;
  }

 private:
  std::string field(const std::string& name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? "" : found->second;
  }

  int64_t count(const std::string& name) const {
    const std::string text = field(name);
    if (text.empty()) return 1;
    const auto value = parse_number(text);
    if (!value || !(*value >= 1 && *value <= most_planes) || *value != std::floor(*value))
      fail_volume(path_, "has a description with a wrong \"" + name + "\": \"" + text.substr(0, 40) + '"');
    return static_cast<int64_t>(*value);
  }

  const std::string& path_;
  std::map<std::string, std::string> fields_;
};

#ifdef OMBRE_3MF

// OME-XML (Open Microscopy Environment, OME-TIFF specification).
class OmeDescription {
 public:
  OmeDescription(const std::string& path, const std::string& text, Diagnostics& diagnostics)
      : path_(path), xml_(path, text, diagnostics) {}

  PageAxes axes() const {
    const pugi::xml_node root = xml_.root("OME");
    const pugi::xml_node image = child(root, "Image"), pixels = child(image, "Pixels");
    if (!pixels) fail_volume(path_, "has an OME description without pixels");
    PageAxes axes;
    axes.slices = count(pixels, "SizeZ");
    axes.channels = count(pixels, "SizeC");
    axes.frames = count(pixels, "SizeT");
    read_channels(pixels, axes);
    if (axes.slices > most_planes / axes.channels || axes.slices * axes.channels > most_planes / axes.frames)
      fail_volume(path_, "has an OME description of more than 100000 planes");
    axes.order = order(pixels);
    axes.x_mm = length(pixels, "PhysicalSizeX");
    axes.y_mm = length(pixels, "PhysicalSizeY");
    axes.z_mm = length(pixels, "PhysicalSizeZ");
    read_pages(pixels, axes);
    if (const size_t others = count_images(root) - 1; others > 0)
      axes.warnings.push_back("the volume \"" + path_ + "\" describes " + std::to_string(others + 1) +
                              " images; only the first is read");
    return axes;
  }

 private:
  static pugi::xml_node child(pugi::xml_node node, std::string_view name) {
    for (const pugi::xml_node one : node.children())
      if (local_name(one) == name) return one;
    return {};
  }

  static size_t count_images(pugi::xml_node root) {
    return static_cast<size_t>(
        std::ranges::count_if(root.children(), [](pugi::xml_node node) { return local_name(node) == "Image"; }));
  }

  int64_t count(pugi::xml_node node, std::string_view name) const {
    const uint64_t value = xml_.count(node, xml_.required(node, name), name);
    if (value < 1 || value > most_planes)
      fail_volume(path_, "has an OME description with a wrong " + std::string(name));
    return static_cast<int64_t>(value);
  }

  // Samples of one pixel, such as red, green and blue, share a page.
  void read_channels(pugi::xml_node pixels, PageAxes& axes) const {
    int64_t samples = 0, pages = 0;
    for (const pugi::xml_node channel : pixels.children()) {
      if (local_name(channel) != "Channel") continue;
      const auto text = xml_.attribute(channel, "SamplesPerPixel");
      samples += text ? count(channel, "SamplesPerPixel") : 1;
      ++pages;
      axes.channel_names.emplace_back(xml_.attribute(channel, "Name").value_or(""));
    }
    if (pages > 0 && samples == axes.channels) axes.channels = pages;
  }

  std::array<PageAxis, 3> order(pugi::xml_node pixels) const {
    const std::string_view text = xml_.required(pixels, "DimensionOrder");
    std::array<PageAxis, 3> order{};
    std::string letters(text.substr(std::min<size_t>(2, text.size())));
    std::string sorted = letters;
    std::ranges::sort(sorted);
    if (!text.starts_with("XY") || sorted != "CTZ")
      fail_volume(path_, "has an OME description with the DimensionOrder \"" + std::string(text.substr(0, 20)) + '"');
    for (size_t n = 0; n < 3; ++n)
      order[n] = letters[n] == 'Z' ? PageAxis::slices : letters[n] == 'C' ? PageAxis::channels : PageAxis::frames;
    return order;
  }

  std::optional<double> length(pugi::xml_node pixels, const std::string& name) const {
    const auto text = xml_.attribute(pixels, name);
    if (!text) return std::nullopt;
    const double value = xml_.number(pixels, *text, name);
    const auto mm = mm_of_unit(std::string(xml_.attribute(pixels, name + "Unit").value_or("\xC2\xB5m")));
    if (!mm || !(value > 0)) return std::nullopt;
    return value * *mm;
  }

  // TiffData elements say which pages hold which planes, where they name them.
  void read_pages(pugi::xml_node pixels, PageAxes& axes) const {
    std::vector<int64_t> pages(static_cast<size_t>(axes.count()), -1);
    bool is_given = false;
    int64_t named = 0;
    for (const pugi::xml_node data : pixels.children()) {
      if (local_name(data) != "TiffData") continue;
      for (const pugi::xml_node uuid : data.children())
        if (local_name(uuid) == "UUID" && xml_.attribute(uuid, "FileName")) check_file(data, uuid);
      if (!xml_.attribute(data, "IFD") && !xml_.attribute(data, "FirstZ") && !xml_.attribute(data, "PlaneCount"))
        continue;
      is_given = true;
      const auto number = [&](const char* name, uint64_t otherwise) {
        const auto text = xml_.attribute(data, name);
        return static_cast<int64_t>(std::min<uint64_t>(text ? xml_.count(data, *text, name) : otherwise, most_planes));
      };
      const int64_t first = number("IFD", 0);
      const int64_t begin = axes.plane(number("FirstZ", 0), number("FirstC", 0), number("FirstT", 0));
      const bool has_one = xml_.attribute(data, "IFD").has_value();
      const int64_t planes = number("PlaneCount", has_one ? 1 : static_cast<uint64_t>(axes.count()));
      if (planes > 0 && begin >= axes.count())
        fail_volume(path_, "has an OME description of planes that it does not have");
      for (int64_t n = 0; n < planes && begin + n < axes.count(); ++n, ++named)
        pages[static_cast<size_t>(begin + n)] = first + n;
      if (named > 2 * axes.count()) fail_volume(path_, "has an OME description that names its planes several times");
    }
    if (!is_given) return;
    if (std::ranges::find(pages, -1) != pages.end())
      fail_volume(path_,
                  "has an OME description that gives no page for some planes; join its files, by Fiji for example");
    axes.pages = std::move(pages);
  }

  // Planes in other files would be missed. A file may have been renamed, so a single name is no sign of others.
  void check_file(pugi::xml_node data, pugi::xml_node uuid) const {
    const std::string name(*xml_.attribute(uuid, "FileName"));
    if (first_file_.empty()) first_file_ = name;
    if (name != first_file_)
      xml_.fail_at(data,
                   "the planes lie in several files: " + formats::quoted(first_file_) + " and " + formats::quoted(name),
                   "join them, by Fiji for example");
  }

  const std::string& path_;
  XmlFile xml_;
  mutable std::string first_file_;
};

PageAxes ome_axes(const std::string& path, const std::string& text) {
  Diagnostics diagnostics;
  try {
    return OmeDescription(path, text, diagnostics).axes();
  } catch (const DesignError&) {
    fail_volume(path, "has an OME description that cannot be read: " + sentence_of(diagnostics.list().front()));
  }
}

#else

PageAxes ome_axes(const std::string& path, const std::string&) {
  fail_volume(path, "has an OME description, which this build cannot read");
}

#endif

}  // namespace

int64_t PageAxes::plane(int64_t slice, int64_t channel, int64_t frame) const {
  int64_t plane = 0, step = 1;
  for (const PageAxis axis : order) {
    const bool is_slice = axis == PageAxis::slices, is_channel = axis == PageAxis::channels;
    plane += step * (is_slice ? slice : is_channel ? channel : frame);
    step *= is_slice ? slices : is_channel ? channels : frames;
  }
  return plane;
}

std::optional<PageAxes> page_axes(const std::string& path, const std::string& description) {
  if (description.starts_with("ImageJ=")) return ImageJDescription(path, description).axes();
  constexpr size_t sniffed = 4096;
  const std::string_view begin = std::string_view(description).substr(0, sniffed);
  if (trim(begin).starts_with('<') && begin.find("<OME") != std::string_view::npos) return ome_axes(path, description);
  return std::nullopt;
}

}  // namespace ombre::formats
