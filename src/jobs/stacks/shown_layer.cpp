#include "jobs/stacks/shown_layer.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "export/image_stack.h"
#include "formats/images/png.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/layer_files.h"

namespace ombre::compile {
namespace {

using formats::PngImage;
using formats::Rgba;
using voxel::ChannelType;

uint32_t packed(const Rgba& colour) {
  return uint32_t{colour[0]} << 24 | uint32_t{colour[1]} << 16 | uint32_t{colour[2]} << 8 | colour[3];
}

std::string colour_text(uint32_t colour) {
  std::vector<std::string> bytes;
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(std::to_string(colour >> shift & 255));
  return "(" + join(bytes, ", ") + ")";
}

// The content of one file of a layer: a channel, or one material of it.
struct FileContent {
  size_t channel = 0;
  const SliceMaterial* material = nullptr;  // null if it shows all of the channel
};

std::vector<FileContent> contents_of(const SliceRequest& request) {
  std::vector<FileContent> contents;
  for (size_t n = 0; n < request.channels.size(); ++n) {
    if (request.channels[n].type != ChannelType::material || !request.files.has_material())
      contents.push_back({n, nullptr});
    else
      for (const SliceMaterial& material : request.materials) contents.push_back({n, &material});
  }
  return contents;
}

// The colours that an image of materials may have, and what they stand for.
struct Colours {
  std::vector<std::pair<uint32_t, uint32_t>> meaning;  // packed colour, look
  // Returns `shows_nothing` for another colour.
  uint32_t of(uint32_t colour) const {
    const auto found = std::ranges::find(meaning, colour, &std::pair<uint32_t, uint32_t>::first);
    return found == meaning.end() ? shows_nothing : found->second;
  }
};

class FileReader {
 public:
  FileReader(const SliceRequest& request, const Appearance& appearance, const FileContent& content, std::string name,
             int64_t layer, Findings& findings)
      : request_(request),
        appearance_(appearance),
        content_(content),
        channel_(request.channels[content.channel]),
        name_(std::move(name)),
        layer_(layer),
        findings_(findings) {}

  // Adds the file to what the channel shows. Returns false if it cannot be read, or has another size.
  bool read(std::string_view bytes, Shown& shown) {
    try {
      const PngImage image = formats::decode_png(bytes, name_, most_pixels());
      if (!has_size(image)) return false;
      check_pitch(image);
      check_kind(image);
      if (channel_.type == ChannelType::dose16)
        take_deep(bytes, shown);
      else
        take(image, shown);
      return true;
    } catch (const Error& error) {
      add("unreadable", error.what());
      return false;
    }
  }

 private:
  int64_t width() const { return request_.lattice.count[0]; }
  int64_t height() const { return request_.lattice.count[1]; }
  uint64_t most_pixels() const { return std::max<uint64_t>(1'000'000, 2 * static_cast<uint64_t>(width() * height())); }
  void add(const std::string& kind, const std::string& text) { findings_.push_back({kind, text, layer_}); }

  bool has_size(const PngImage& image) {
    if (image.width == width() && image.height == height()) return true;
    add("size", name_ + " is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " pixels; layers of the job are " + std::to_string(width()) + " x " + std::to_string(height()));
    return false;
  }

  void check_pitch(const PngImage& image) {
    const auto dots = [&](size_t axis) {
      return static_cast<uint32_t>(std::lround(request_.lattice.pitch[axis].dots_per_metre()));
    };
    if (image.dots_per_metre_x == dots(0) && image.dots_per_metre_y == dots(1)) return;
    add("pitch", name_ + " has " + std::to_string(image.dots_per_metre_x) + " x " +
                     std::to_string(image.dots_per_metre_y) + " pixels a metre; the pitch of the job makes " +
                     std::to_string(dots(0)) + " x " + std::to_string(dots(1)));
  }

  // Checks that the file has the kind of pixels that the format has.
  void check_kind(const PngImage& image) {
    const bool is_indexed = request_.format == ImageFormat::indexed;
    int bits = 8;
    if (request_.format == ImageFormat::mask) bits = 1;
    if (channel_.type == ChannelType::dose16) bits = 16;
    if ((image.format == ImageFormat::indexed) == is_indexed && (is_indexed || image.bit_depth == bits)) return;
    add("format", name_ + (image.format == ImageFormat::indexed ? " has a palette" : " has no palette") + " and " +
                      std::to_string(image.bit_depth) + " bits a sample; job.json says otherwise");
  }

  // Calls place(n, row, column) for each voxel n of the layer, with its pixel.
  template <class Place>
  void for_each_pixel(const Place& place) const {
    size_t n = 0;
    for (int64_t j = 0; j < height(); ++j) {
      const auto row = static_cast<uint32_t>(request_.flip_y ? j : height() - 1 - j);
      for (int64_t i = 0; i < width(); ++i)
        place(n++, row, static_cast<uint32_t>(request_.flip_x ? width() - 1 - i : i));
    }
  }

  void take_deep(std::string_view bytes, Shown& shown) {
    const formats::GrayImage image = formats::decode_gray_png(bytes, name_, most_pixels());
    for_each_pixel(
        [&](size_t n, uint32_t row, uint32_t column) { shown[n] = image.pixels[size_t{row} * image.width + column]; });
  }

  void take(const PngImage& image, Shown& shown) {
    if (channel_.type == ChannelType::material) return take_materials(image, shown);
    const bool is_mask = channel_.type == ChannelType::mask;
    for_each_pixel([&](size_t n, uint32_t row, uint32_t column) {
      const Rgba colour = image.colour(column, row);
      if (channel_.type == ChannelType::colour)
        shown[n] = packed(colour);
      else
        shown[n] = is_mask ? uint32_t{colour[0] > 0} : colour[0];
    });
  }

  Colours colours() const {
    if (request_.format == ImageFormat::mask)
      return {
          {{packed(exporting::mask_off), 0}, {packed({255, 255, 255, 255}), appearance_.of(content_.material->id)}}};
    Colours all{{{packed(exporting::shown(request_.background, request_.format)), 0}}};
    for (const SliceMaterial& material : request_.materials)
      if (!content_.material || content_.material == &material)
        all.meaning.emplace_back(packed(exporting::shown(material.rgba, request_.format)), appearance_.of(material.id));
    return all;
  }

  // Returns what each entry of a palette shows, and reports entries that are not the job's.
  std::vector<uint32_t> entries(const PngImage& image) {
    std::vector<uint32_t> shows(256, shows_nothing);
    for (size_t n = 0; n < image.palette.size() && n <= request_.materials.size(); ++n) {
      const Rgba wanted = n == 0 ? request_.background : request_.materials[n - 1].rgba;
      const std::string of = n == 0 ? "void" : request_.materials[n - 1].name;
      if (image.palette[n] != wanted)
        add("colour", name_ + " has " + colour_text(packed(image.palette[n])) + " as entry " + std::to_string(n) +
                          " of its palette, where " + of + " has " + colour_text(packed(wanted)) + " in job.json");
      const bool may_show = n == 0 || !content_.material || content_.material == &request_.materials[n - 1];
      if (may_show) shows[n] = n == 0 ? 0 : appearance_.of(request_.materials[n - 1].id);
    }
    return shows;
  }

  void take_materials(const PngImage& image, Shown& shown) {
    const bool is_indexed = image.format == ImageFormat::indexed;
    const Colours known = is_indexed ? Colours() : colours();
    const std::vector<uint32_t> shows = is_indexed ? entries(image) : std::vector<uint32_t>();
    uint32_t last_colour = 0, last_look = is_indexed ? 0 : known.of(0);
    for_each_pixel([&](size_t n, uint32_t row, uint32_t column) {
      if (is_indexed) return put(shows[image.pixels[size_t{row} * image.width + column]], image, row, column, shown[n]);
      const uint32_t colour = packed(image.colour(column, row));
      if (colour != last_colour) last_look = known.of(last_colour = colour);
      put(last_look, image, row, column, shown[n]);
    });
    report_strange();
  }

  void put(uint32_t look, const PngImage& image, uint32_t row, uint32_t column, uint32_t& voxel) {
    if (look == shows_nothing && strange_++ == 0)
      first_strange_ = colour_text(packed(image.colour(column, row))) + ", at column " + std::to_string(column) +
                       " and row " + std::to_string(row);
    if (content_.material && look == 0) return;
    if (content_.material && voxel != 0) ++overlaps_;
    voxel = look;
  }

  void report_strange() {
    if (strange_ > 0)
      add("colour", name_ + " has " + format_count(strange_) +
                        " pixels that are of no material of job.json; the first one is " + first_strange_);
    if (overlaps_ > 0)
      add("overlap", name_ + " has " + format_count(overlaps_) + " voxels that the image of another material has, too");
  }

  const SliceRequest& request_;
  const Appearance& appearance_;
  const FileContent& content_;
  const voxel::Channel& channel_;
  std::string name_;
  int64_t layer_;
  Findings& findings_;
  uint64_t strange_ = 0, overlaps_ = 0;
  std::string first_strange_;
};

struct PixelsShown {
  const Appearance* appearance;  // null for shades

  Shown operator()(const RunLayer& layer) const {
    Shown shown;
    std::vector<MaterialId> row(layer.width());
    for (uint32_t j = 0; j < layer.height(); ++j) {
      layer.row(j).unpack(row.data());
      for (const MaterialId id : row) shown.push_back(appearance ? appearance->of(id) : id);
    }
    return shown;
  }
  Shown operator()(const voxel::Raster<uint16_t>& raster) const { return {raster.values.begin(), raster.values.end()}; }
  Shown operator()(const voxel::Raster<voxel::Colour>& raster) const {
    Shown shown;
    for (const voxel::Colour& colour : raster.values) shown.push_back(packed(colour));
    return shown;
  }
};

}  // namespace

Appearance::Appearance(const SliceRequest& request) {
  // Materials that the job does not list look like nothing of it.
  of_.fill(shows_nothing - 1);
  of_[0] = 0;
  const bool tells_all = request.format == ImageFormat::indexed || request.format == ImageFormat::mask;
  const auto look = [&](const Rgba& colour) { return exporting::shown(colour, request.format); };
  for (const SliceMaterial& material : request.materials) {
    of_[material.id] = material.id;
    if (tells_all) continue;
    if (look(material.rgba) == look(request.background)) of_[material.id] = 0;
    for (const SliceMaterial& earlier : request.materials) {
      if (&earlier == &material || request.files.has_material()) break;
      if (of_[material.id] != 0 && look(earlier.rgba) == look(material.rgba)) {
        of_[material.id] = of_[earlier.id];
        break;
      }
    }
    if (of_[material.id] != material.id) hidden_.push_back(material.name);
  }
}

Shown shown_of(const voxel::ChannelPixels& pixels, ChannelType type, const Appearance& appearance) {
  return std::visit(PixelsShown{type == ChannelType::material ? &appearance : nullptr}, pixels);
}

size_t LayerReader::voxels() const {
  return static_cast<size_t>(request_.lattice.count[0]) * static_cast<size_t>(request_.lattice.count[1]);
}

std::vector<Shown> LayerReader::blank() const { return std::vector<Shown>(request_.channels.size(), Shown(voxels())); }

std::optional<std::vector<Shown>> LayerReader::read(int64_t layer, const std::vector<std::string>& names,
                                                    const std::vector<std::string>& bytes, Findings& findings) const {
  const std::vector<FileContent> contents = contents_of(request_);
  std::vector<Shown> channels = blank();
  bool is_read = names.size() == contents.size();
  for (size_t n = 0; n < names.size() && n < contents.size(); ++n)
    is_read &= FileReader(request_, appearance_, contents[n], names[n], layer, findings)
                   .read(bytes[n], channels[contents[n].channel]);
  return is_read ? std::optional(std::move(channels)) : std::nullopt;
}

std::vector<uint64_t> LayerReader::counts(const std::vector<Shown>& channels) const {
  std::vector<uint64_t> counts;
  for (size_t n = 0; n < channels.size(); ++n) {
    const ChannelType type = request_.channels[n].type;
    if (type == ChannelType::material) {
      std::array<uint64_t, 256> of{};
      for (const uint32_t look : channels[n])
        if (look < of.size()) ++of[look];
      for (const SliceMaterial& material : request_.materials)
        counts.push_back(appearance_.of(material.id) == material.id ? of[material.id] : 0);
      continue;
    }
    const auto is_counted = [&](uint32_t value) { return (type == ChannelType::colour ? value & 255 : value) > 0; };
    counts.push_back(static_cast<uint64_t>(std::ranges::count_if(channels[n], is_counted)));
  }
  return counts;
}

std::vector<std::string> LayerReader::counted() const { return shown_names(request_); }

std::vector<uint64_t> LayerReader::seen_together(const std::vector<uint64_t>& stated) const {
  std::vector<uint64_t> together = stated;
  for (size_t n = 0; n < request_.materials.size(); ++n) {
    const uint32_t look = appearance_.of(request_.materials[n].id);
    if (look == request_.materials[n].id) continue;
    together[n] = 0;
    for (size_t other = 0; other < request_.materials.size(); ++other)
      if (look != 0 && request_.materials[other].id == look) together[other] += stated[n];
  }
  return together;
}

void LayerReader::compare_counts(const std::vector<Shown>& channels, const stores::Entry& entry,
                                 Findings& findings) const {
  const auto line = layer_of(entry, layer_sizes(request_));
  if (!line) return;
  const std::vector<uint64_t> stated = seen_together(line->counts.voxels), found = counts(channels);
  const std::vector<std::string> names = counted();
  for (size_t n = 0; n < found.size(); ++n)
    if (stated[n] != found[n])
      findings.push_back({"counts",
                          "the images of layer " + std::to_string(entry.id) + " have " + format_count(found[n]) +
                              " voxels of " + names[n] + "; the journal says " + format_count(stated[n]),
                          entry.id});
  size_t dose = 0;
  for (size_t n = 0; n < channels.size(); ++n) {
    if (!voxel::channel_kind(request_.channels[n].type).is_dose()) continue;
    uint64_t sum = 0;
    for (const uint32_t shade : channels[n]) sum += shade;
    const uint64_t said = line->counts.shades[dose++];
    if (sum != said)
      findings.push_back({"counts",
                          "the shades of " + request_.channels[n].name + " in layer " + std::to_string(entry.id) +
                              " add up to " + format_count(sum) + "; the journal says " + format_count(said),
                          entry.id});
  }
}

}  // namespace ombre::compile
