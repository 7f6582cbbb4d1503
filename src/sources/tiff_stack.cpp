#include "sources/tiff_stack.h"

#include <numeric>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/volumes/page_axes.h"

namespace ombre::sources {
namespace {

using formats::PageAxes;

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw Error(Code::file_content, "the volume \"" + path + "\" " + message, {{"file", path}});
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (size_t n = 0; n < names.size(); ++n)
    if (!names[n].empty()) text += (text.empty() ? " (" : ", ") + std::to_string(n) + ": " + names[n];
  return text.empty() ? "" : text + ")";
}

// A parameter that chooses one of several. Its numbers begin with `first`; a smaller one chooses nothing.
struct Choice {
  const char *what, *parameter;
  int first;
};
constexpr Choice of_channels{"channels", "channel", 0}, of_frames{"frames in time", "phase", 1};

// Returns the chosen one of several, from 0.
int64_t chosen(const std::string& path, const Choice& choice, int64_t count, int wanted,
               const std::string& names = "") {
  const auto [what, parameter, first] = choice;
  const int64_t last = first + count - 1;
  if (count > 1 && wanted < first)
    fail(path, "has " + std::to_string(count) + ' ' + what + names + "; choose one by " + parameter + '=' +
                   std::to_string(first) + ", up to " + std::to_string(last));
  if (wanted > last)
    fail(path, std::string("has no ") + parameter + ' ' + std::to_string(wanted) + "; " + std::to_string(first) + ' ' +
                   (count > 1 ? "to " + std::to_string(last) + " are" : "is") + " there");
  return std::max(wanted - first, 0);
}

// ImageJ's unit of length is also that of the pages' resolution.
std::optional<Vec3> spacing_of(const PageAxes& axes, const tiff::Document& document) {
  std::optional<double> x = axes.x_mm, y = axes.y_mm;
  if (axes.is_imagej && axes.unit_mm && document.pixels_x > 0 && document.pixels_y > 0) {
    x = *axes.unit_mm / document.pixels_x;
    y = *axes.unit_mm / document.pixels_y;
  }
  if (!x || !y || !axes.z_mm) return std::nullopt;
  return Vec3{*x, *y, *axes.z_mm};
}

void check_pages(const std::string& path, const PageAxes& axes, size_t pages) {
  const auto count = static_cast<size_t>(axes.count());
  if (axes.pages.empty() && pages != count)
    fail(path, "has " + std::to_string(pages) + " pages, where its description gives " + std::to_string(count) + ": " +
                   std::to_string(axes.slices) + " slices, " + std::to_string(axes.channels) + " channels and " +
                   std::to_string(axes.frames) + " frames");
  for (const int64_t page : axes.pages)
    if (page < 0 || page >= static_cast<int64_t>(pages))
      fail(path, "lacks page " + std::to_string(page) + ", which its description names");
}

}  // namespace

ChosenPages chosen_pages(const std::string& path, const tiff::Document& document, const formats::VolumeChoice& choice) {
  ChosenPages result{{}, choice.channel, {}, {}};
  if (document.reduced > 0)
    result.warnings.push_back("the volume \"" + path + "\" has " + std::to_string(document.reduced) +
                              (document.reduced == 1 ? " page that is a thumbnail or mask; it is left out"
                                                     : " pages that are thumbnails or masks; they are left out"));
  const auto axes = formats::page_axes(path, document.description);
  if (!axes) {
    chosen(path, of_frames, 1, choice.phase);
    result.pages.resize(document.pages.size());
    std::iota(result.pages.begin(), result.pages.end(), size_t{0});
    return result;
  }
  check_pages(path, *axes, document.pages.size());
  const auto values = static_cast<int>(document.pages.front().channels);
  const bool has_channels = axes->channels > 1;
  const int64_t channel =
      !has_channels
          ? 0
          : chosen(path, of_channels, axes->channels * values, choice.channel, listed(axes->channel_names)) / values;
  const int64_t frame = chosen(path, of_frames, axes->frames, choice.phase);
  if (has_channels) result.channel = values > 1 ? choice.channel % values : -1;
  for (int64_t slice = 0; slice < axes->slices; ++slice) {
    const auto plane = static_cast<size_t>(axes->plane(slice, channel, frame));
    result.pages.push_back(axes->pages.empty() ? plane : static_cast<size_t>(axes->pages[plane]));
  }
  result.spacing_mm = spacing_of(*axes, document);
  result.warnings.insert(result.warnings.end(), axes->warnings.begin(), axes->warnings.end());
  return result;
}

}  // namespace ombre::sources
