// Loads stacks of coloured images: voxels whose colours represent materials.
#include <algorithm>
#include <filesystem>
#include <map>

#include "base/text/error.h"
#include "import/fields/volume_source.h"
#include "sources/file_numbers.h"
#include "sources/layer_images.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t most_voxels = uint64_t{1} << 33;
constexpr size_t most_colours = 65535;

// Builds a volume of the numbers of the voxels' colours; 0 is transparent.
class StackBuilder {
 public:
  // Constructs a builder for at least this number of layers.
  explicit StackBuilder(size_t layers) : files_(layers) {}

  void add(const sources::LayerColours& image, const std::string& path) {
    if (volume_.empty()) start(image, path);
    if (image.width != width_ || image.height != height_)
      throw Error(Code::file_content,
                  "the image \"" + path + "\" has " + size_text(image.width, image.height) +
                      " pixels, but those below it have " + size_text(width_, height_) +
                      "; all images of a stack need the same size",
                  {{"file", path}});
    // Rows of images run downwards, rows of voxels along y.
    for (uint32_t row = image.height; row-- > 0;)
      for (size_t n = size_t{4} * row * image.width; n < size_t{4} * (row + 1) * image.width; n += 4)
        volume_.push_back(number_of({image.rgba[n], image.rgba[n + 1], image.rgba[n + 2], image.rgba[n + 3]}, path));
    ++layers_;
  }

  formats::VoxelVolume take() {
    formats::VoxelVolume volume;
    volume.count = {width_, height_, static_cast<int64_t>(layers_)};
    constexpr size_t most_in_bytes = 255;
    if (colours_.size() <= most_in_bytes) {
      volume.type = "uint8";
      std::vector<uint8_t> small;
      small.reserve(volume_.size());
      for (const uint16_t number : volume_) small.push_back(static_cast<uint8_t>(number));
      volume.values = std::move(small);
    } else {
      volume.type = "uint16";
      volume.values = std::move(volume_);
    }
    volume.space_from_index = Affine{};
    return volume;
  }
  const std::vector<Rgba>& colours() const { return colours_; }

 private:
  static std::string size_text(uint32_t width, uint32_t height) {
    return std::to_string(width) + " x " + std::to_string(height);
  }

  void start(const sources::LayerColours& image, const std::string& path) {
    width_ = image.width;
    height_ = image.height;
    const uint64_t pixels = uint64_t{width_} * height_;
    if (pixels > most_voxels / files_)
      throw Error(Code::too_large, "the images beginning with \"" + path + "\" have more than " +
                                       std::to_string(most_voxels) + " voxels together; cut them or make them coarser");
    volume_.reserve(pixels * files_);
  }

  uint16_t number_of(const Rgba& colour, const std::string& path) {
    if (colour[3] == 0) return 0;
    if (colour == last_colour_) return last_;
    const auto [it, is_new] = numbers_.try_emplace(colour, static_cast<uint16_t>(colours_.size() + 1));
    if (is_new && colours_.size() == most_colours)
      throw Error(Code::file_content,
                  "the images up to \"" + path + "\" have more than 65535 colours; give each material one colour",
                  {{"file", path}});
    if (is_new) colours_.push_back(colour);
    last_colour_ = colour;
    return last_ = it->second;
  }

  size_t files_, layers_ = 0;
  uint32_t width_ = 0, height_ = 0;
  std::vector<uint16_t> volume_;
  std::vector<Rgba> colours_;
  std::map<Rgba, uint16_t> numbers_;
  Rgba last_colour_{};
  uint16_t last_ = 0;
};

// Returns the image, or the images in a folder in the order of the numbers in their names. Throws Error.
std::vector<std::string> images_at(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<std::string> images;
  for (const auto& entry : fs::directory_iterator(path, error))
    if (sources::has_image_name(entry.path().string())) images.push_back(entry.path().string());
  if (error)
    throw Error(Code::cannot_read, "the folder \"" + path + "\" cannot be read: " + error.message(), {{"file", path}});
  if (images.empty())
    throw Error(Code::file_missing, "the folder \"" + path + "\" has no images; .png, .tif and .bmp are read",
                {{"file", path}});
  std::ranges::sort(images, sources::is_numbered_before);
  return images;
}

void report_gaps(const std::vector<std::string>& images, const Reader& reader) {
  const auto missing = sources::missing_number(images);
  if (missing)
    reader.diagnostics.warning(reader.where,
                               "the images have a gap: number " + std::to_string(*missing) + " is missing",
                               "the layers above it move down by one");
}

}  // namespace

std::shared_ptr<const ColourGrid> ImageStackRequest::load(sources::Loading& loading) {
  if (!loading.find(file)) return nullptr;
  const Reader& reader = loading.reader();
  std::vector<FilePath> images;
  try {
    for (const std::string& path : images_at(file.path)) images.push_back({path, {}});
  } catch (const Error& error) {
    reader.diagnostics.error(reader.where, error.what());
    return nullptr;
  }
  sources::Key key("image stack");
  for (FilePath& image : images) {
    if (!loading.read_content(image)) return nullptr;
    key.add(image.content);
  }
  file.content = key.hash();
  using Made = sources::Loading::Made<ColourGrid>;
  return loading.cached<ColourGrid>(key.hash(), file.path, [&](const Reader& reporter) {
    StackBuilder stack(images.size());
    std::vector<std::string> names;
    for (const FilePath& image : images) {
      if (loading.stop() && loading.stop()->requested()) throw Cancelled();
      for (const sources::LayerColours& layer :
           sources::read_layer_colours(image.path, *loading.bytes(image), loading.stop()))
        stack.add(layer, image.path);
      names.push_back(image.path);
    }
    report_gaps(names, reporter);
    auto made = importing::make_volume_source(file.path, stack.take(), key.hash());
    auto grid = std::make_shared<ColourGrid>();
    grid->grid.source = made.source;
    grid->grid.space_from_index = Affine{};
    grid->grid.places = made.places;
    grid->colours = stack.colours();
    return Made{std::move(grid), made.bytes};
  });
}

}  // namespace ombre::design
