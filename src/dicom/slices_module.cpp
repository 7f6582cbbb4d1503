// Chooses the files of a series, and puts their frames together to a grid.
#include <gdcmScanner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/text/error.h"
#include "base/text/text.h"
#include "dicom/gdcm_frames.h"
#include "dicom/gdcm_slices.h"
#include "dicom/phases.h"
#include "dicom/segmentation.h"
#include "dicom/tags.h"

namespace ombre::dicom {
namespace {

const gdcm::Tag series_uid(0x0020, 0x000e), series_number(0x0020, 0x0011), modality(0x0008, 0x0060),
    image_type(0x0008, 0x0008);

struct File {
  std::string path, uid, number, kind, size;
  bool is_localizer = false, is_capture = false;

  bool is_aside() const { return is_localizer || is_capture; }
};

class Reading {
 public:
  Reading(const std::string& name, const std::vector<std::string>& files, const SeriesChoice& choice)
      : name_(name), choice_(choice) {
    scan(files);
  }

  Series read() {
    for (const File& file : chosen())
      for (Frame& frame : read_frames(name_, file.path, warnings_)) slices_.push_back(std::move(frame));
    check_sizes();
    const bool is_segmentation = slices_.front().segment > 0;
    if (is_segmentation)
      slices_ = label_slices(name_, std::move(slices_), choice_.label);
    else
      sort_slices();
    fill_padding();
    if (!is_segmentation) check_steps();
    return finished();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Code::file_content, "the scan \"" + name_ + "\" " + message, {{"file", name_}});
  }

  void warn(const std::string& message) { warnings_.push_back("the scan \"" + name_ + "\" " + message); }

  void scan(const std::vector<std::string>& paths) {
    gdcm::Scanner scanner;
    for (const gdcm::Tag& tag : {series_uid, series_number, modality, sop_class, image_type, rows, columns})
      scanner.AddTag(tag);
    scanner.Scan(paths);
    for (const std::string& path : paths) {
      if (!scanner.IsKey(path.c_str())) continue;
      const auto text = [&](const gdcm::Tag& tag) {
        const char* value = scanner.GetValue(path.c_str(), tag);
        return value ? std::string(trim(value)) : std::string();
      };
      if (text(rows).empty() || text(columns).empty()) continue;  // not an image: a directory or a report
      files_.push_back({path, text(series_uid), text(series_number), text(modality), text(columns) + " x " + text(rows),
                        text(image_type).find("LOCALIZER") != std::string::npos,
                        text(sop_class).starts_with("1.2.840.10008.5.1.4.1.1.7")});
    }
    if (files_.empty()) fail("holds no DICOM images");
  }

  // Leaves out localizers and secondary captures beside other images, which are no slices of a volume.
  void set_aside(std::vector<File>& files) {
    if (std::ranges::all_of(files, &File::is_aside)) return;
    const auto localizers = std::ranges::count_if(files, &File::is_localizer),
               captures = std::ranges::count_if(files, &File::is_aside) - localizers;
    if (localizers + captures == 0) return;
    const auto counted = [](ptrdiff_t count, const std::string& what) {
      return count == 0 ? std::string() : std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
    };
    warn("holds " + counted(localizers, "localizer") + (localizers > 0 && captures > 0 ? " and " : "") +
         counted(captures, "secondary capture") + ", which are left out");
    std::erase_if(files, [](const File& file) { return file.is_aside(); });
  }

  std::vector<File> chosen() {
    if (choice_.series.empty()) set_aside(files_);
    std::map<std::string, std::vector<File>> series;
    for (const File& file : files_) series[file.uid].push_back(file);
    std::vector<File> found;
    size_t matches = 0;
    for (const auto& [uid, files] : series) {
      const bool is_meant =
          choice_.series.empty() ? series.size() == 1 : uid == choice_.series || files[0].number == choice_.series;
      if (!is_meant) continue;
      found = files;
      ++matches;
    }
    if (matches != 1) fail_to_choose(series, matches);
    if (!choice_.series.empty()) set_aside(found);
    return found;
  }

  [[noreturn]] void fail_to_choose(const std::map<std::string, std::vector<File>>& series, size_t matches) const {
    std::string list;
    for (const auto& [uid, files] : series)
      list += (list.empty() ? "" : "; ") + ("series " + files[0].number) + ": " + files[0].kind + ", " +
              std::to_string(files.size()) + (files.size() == 1 ? " file" : " files") + " of " + files[0].size +
              ", UID " + uid;
    const std::string hint = "; choose one by series=\"" + series.begin()->second[0].number + "\" or its UID";
    fail((choice_.series.empty() ? "holds " + std::to_string(series.size()) + " series"
          : matches == 0         ? "holds no series \"" + choice_.series + '"'
                                 : "holds several series with the number " + choice_.series) +
         ": " + list + hint);
  }

  static std::string named(const Frame& frame) {
    return '"' + frame.path + '"' + (frame.number > 0 ? " (frame " + std::to_string(frame.number + 1) + ")" : "");
  }

  Vec3 normal() const { return cross(slices_[0].directions[0], slices_[0].directions[1]); }
  double height(const Frame& slice) const { return dot(slice.place, normal()); }

  void check_sizes() const {
    const Frame& first = slices_[0];
    for (const Frame& slice : slices_) {
      if (slice.count != first.count || (slice.segment > 0) != (first.segment > 0))
        fail("has slices of different sizes: " + named(first) + " and " + named(slice));
      constexpr double tolerance = 1e-3;
      for (size_t n = 0; n < 2; ++n)
        if (length(slice.directions[n] - first.directions[n]) > tolerance ||
            std::abs(slice.spacing[n] - first.spacing[n]) > tolerance * first.spacing[n])
          fail("has slices that lie in different ways: " + named(first) + " and " + named(slice));
    }
  }

  // Slices without places are stacked in the order of their numbers, where their distance is known.
  void stack_without_places() {
    const auto placed = std::ranges::count_if(slices_, &Frame::has_place);
    if (placed == static_cast<ptrdiff_t>(slices_.size()) || slices_.size() == 1) return;
    if (placed > 0) fail("has slices that do not say where they lie; remove them or export the scan again");
    std::ranges::stable_sort(slices_, {}, &Frame::instance);
    if (slices_[0].step == 0) slices_[0].has_spacing = false;
    const double step = slices_[0].step > 0 ? slices_[0].step : 1;
    for (size_t n = 0; n < slices_.size(); ++n)
      slices_[n].place = slices_[0].place + static_cast<double>(n) * step * normal();
    warn("does not say where its slices lie; they are stacked in the order of their numbers");
  }

  void sort_slices() {
    stack_without_places();
    std::ranges::stable_sort(slices_, {}, [&](const Frame& slice) { return height(slice); });
    PhaseResult result = frames_of_phase(name_, std::move(slices_), choice_.phase);
    slices_ = std::move(result.frames);
    if (result.doubles > 0)
      warn("has " + std::to_string(result.doubles) + (result.doubles == 1 ? " slice" : " slices") +
           " twice at one place; \"" + result.first_double +
           (result.doubles == 1 ? "\" is left out" : "\" and others are left out"));
  }

  // Puts a number in the place of padding, which lies outside of what was scanned.
  void fill_padding() {
    if (std::ranges::all_of(slices_, [](const Frame& slice) { return slice.padding.empty(); })) return;
    const auto number = static_cast<float>(choice_.outside ? *choice_.outside : number_outside());
    padding_ = number;
    for (Frame& slice : slices_)
      for (const uint32_t n : slice.padding) slice.values[n] = number;
  }

  // Returns a number for padding: the least or the greatest of the others. Where all of these lie within a solid, it is
  // as far beyond the solid's level as they are within, at least by 1, so that the surface runs in the middle.
  double number_outside() const {
    const std::optional<float> extreme = extreme_value();
    if (!choice_.level) return extreme.value_or(0);
    const double level = *choice_.level, other = extreme.value_or(static_cast<float>(level));
    if (choice_.is_outside_high)
      return other > level ? other : std::max(std::ceil(2 * level - other), std::ceil(level) + 1);
    return other < level ? other : std::min(std::floor(2 * level - other), std::floor(level) - 1);
  }

  // Returns the least or the greatest value that is no padding.
  std::optional<float> extreme_value() const {
    std::optional<float> found;
    for (const Frame& slice : slices_)
      for (size_t n = 0, next = 0; n < slice.values.size(); ++n) {
        if (next < slice.padding.size() && slice.padding[next] == n) {
          ++next;
          continue;
        }
        const float value = slice.values[n];
        if (!found || (choice_.is_outside_high ? value > *found : value < *found)) found = value;
      }
    return found;
  }

  double usual_step() const {
    std::vector<double> steps;
    for (size_t n = 1; n < slices_.size(); ++n) steps.push_back(height(slices_[n]) - height(slices_[n - 1]));
    std::ranges::sort(steps);
    return steps[steps.size() / 2];
  }

  // Returns how far a slice lies from the even grid between the first and the last one: along and across the normal.
  std::array<double, 2> distance_from_grid(size_t n) const {
    const double share = static_cast<double>(n) / static_cast<double>(slices_.size() - 1);
    const Vec3 off =
        slices_[n].place - (slices_.front().place + share * (slices_.back().place - slices_.front().place));
    const double along = dot(off, normal());
    return {std::abs(along), length(off - along * normal())};
  }

  void check_steps() {
    if (slices_.size() < 3) return;
    check_sideways();
    const double step = (height(slices_.back()) - height(slices_.front())) / static_cast<double>(slices_.size() - 1);
    // Scanners round positions, to tenths of a millimetre at the coarsest.
    constexpr double share = 0.1, rounding_mm = 0.0505, most_share = 0.25;
    const double tolerance = std::max(share * step, std::min(rounding_mm, most_share * step));
    bool is_even = true;
    for (size_t n = 0; n < slices_.size(); ++n) is_even = is_even && distance_from_grid(n)[0] <= tolerance;
    if (is_even) return;
    if (choice_.is_regular) return resample();
    fail_uneven();
  }

  // A slice may lie beside the line through the others only as far as rounding goes.
  void check_sideways() const {
    const Frame& first = slices_.front();
    const double tolerance = std::max(0.1 * std::min(first.spacing[0], first.spacing[1]), 0.06);
    const Vec3 line = slices_.back().place - first.place;
    const double rise = dot(line, normal());
    for (const Frame& slice : slices_) {
      const Vec3 off = slice.place - first.place;
      const double aside = length(off - (dot(off, normal()) / rise) * line);
      if (aside > tolerance)
        fail("has slices that jump sideways: " + named(slice) + " lies " + format_rounded(aside, 4) +
             " mm beside the line of the others; resample the scan, by 3D Slicer for example");
    }
  }

  [[noreturn]] void fail_uneven() const {
    const double usual = usual_step();
    constexpr double tolerance = 0.05;
    size_t worst = 1;
    for (size_t n = 1; n < slices_.size(); ++n) {
      const double step = height(slices_[n]) - height(slices_[n - 1]), missing = step / usual - 1;
      const std::string between = " between " + named(slices_[n - 1]) + " and " + named(slices_[n]);
      if (missing > 0.5 && std::abs(missing - std::round(missing)) <= tolerance * (missing + 1))
        fail("lacks " + std::to_string(static_cast<int>(std::round(missing))) +
             (std::round(missing) == 1 ? " slice" : " slices") + between +
             "; copy the missing files, or write regular=true to fill them in linearly");
      const double of_worst = height(slices_[worst]) - height(slices_[worst - 1]);
      if (std::abs(step - usual) > std::abs(of_worst - usual)) worst = n;
    }
    fail("has slices at uneven distances: " + format_rounded(height(slices_[worst]) - height(slices_[worst - 1]), 4) +
         " mm between " + named(slices_[worst - 1]) + " and " + named(slices_[worst]) + ", elsewhere " +
         format_rounded(usual, 4) + " mm; write regular=true to resample them linearly");
  }

  // Interpolates linearly between the slices, at the usual distance.
  void resample() {
    const double first = height(slices_.front()), whole = height(slices_.back()) - first;
    constexpr double most_slices = 100'000;
    const double count = std::round(whole / usual_step()) + 1;
    if (!(count <= most_slices)) fail("has slices that lie too far apart");
    const double step = whole / (count - 1);
    std::vector<Frame> even;
    size_t below = 0;
    for (double n = 0; n < count; ++n) {
      const double at = first + n * step;
      while (below + 2 < slices_.size() && height(slices_[below + 1]) <= at) ++below;
      even.push_back(between(slices_[below], slices_[below + 1], at));
    }
    warn("has slices at uneven distances: " + std::to_string(slices_.size()) + " slices are resampled to " +
         std::to_string(even.size()) + ", " + format_rounded(step, 6) + " mm apart, by linear interpolation");
    slices_ = std::move(even);
  }

  Frame between(const Frame& low, const Frame& high, double at) const {
    const double share = std::clamp((at - height(low)) / (height(high) - height(low)), 0.0, 1.0);
    Frame frame = low;
    frame.place = low.place + share * (high.place - low.place);
    for (size_t n = 0; n < frame.values.size(); ++n)
      frame.values[n] = static_cast<float>((1 - share) * static_cast<double>(low.values[n]) +
                                           share * static_cast<double>(high.values[n]));
    return frame;
  }

  Series finished() {
    const Frame& first = slices_.front();
    Series series;
    series.count = {first.count[0], first.count[1], static_cast<int64_t>(slices_.size())};
    const double alone = first.step > 0 ? first.step : 1;
    const Vec3 step = slices_.size() > 1
                          ? (1.0 / static_cast<double>(slices_.size() - 1)) * (slices_.back().place - first.place)
                          : alone * normal();
    const Vec3 across = first.spacing[0] * first.directions[0], down = first.spacing[1] * first.directions[1];
    for (int axis = 0; axis < 3; ++axis)
      series.lps_from_index.rows[static_cast<size_t>(axis)] = {across[axis], down[axis], step[axis]};
    series.lps_from_index.offset = first.place;
    series.has_lengths = first.has_spacing;
    series.padding = padding_;
    if (slices_.size() == 1 && first.step == 0) warn("does not say how thick its only slice is; it is 1 mm thick here");
    series.slope = first.slope;
    series.intercept = first.intercept;
    series.warnings = warnings_;
    take_values(series);
    return series;
  }

  void take_values(Series& series) {
    const bool is_whole = std::ranges::all_of(slices_, [](const Frame& slice) {
      return std::ranges::all_of(slice.values, [](float v) {
        return v >= std::numeric_limits<int16_t>::min() && v <= std::numeric_limits<int16_t>::max() &&
               v == std::floor(v);
      });
    });
    for (Frame& slice : slices_) {
      for (const float v : slice.values)
        if (is_whole)
          series.whole.push_back(static_cast<int16_t>(v));
        else
          series.real.push_back(v);
      slice.values = {};
    }
  }

  const std::string& name_;
  const SeriesChoice& choice_;
  std::optional<double> padding_;  // the value that was put in its place
  std::vector<File> files_;
  std::vector<Frame> slices_;
  std::vector<std::string> warnings_;
};

}  // namespace

Series read_slices(const std::string& name, const std::vector<std::string>& files, const SeriesChoice& choice) {
  return Reading(name, files, choice).read();
}

}  // namespace ombre::dicom
