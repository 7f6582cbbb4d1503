#include "dicom/gdcm_slices.h"

#include <gdcmImageReader.h>
#include <gdcmScanner.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::dicom {
namespace {

const gdcm::Tag series_uid(0x0020, 0x000e), series_number(0x0020, 0x0011), modality(0x0008, 0x0060),
    rows(0x0028, 0x0010), columns(0x0028, 0x0011), position(0x0020, 0x0032), orientation(0x0020, 0x0037),
    instance_number(0x0020, 0x0013);

struct File {
  std::string path, uid, number, kind, size;
  double instance = 0;
};

class Reading {
 public:
  Reading(const std::string& name, const std::vector<std::string>& files, const std::string& choice)
      : name_(name), choice_(choice) {
    scan(files);
  }

  Series read() {
    const std::vector<File> files = chosen();
    if (files.size() == 1) {
      read_file(files[0]);
      return finished();
    }
    for (const File& file : files) read_file(file);
    sort_slices();
    return finished();
  }

 private:
  struct Slice {
    std::string path;
    Vec3 place;
    std::array<Vec3, 2> directions;  // directions of rows and columns
    std::array<double, 3> spacing{};
    std::array<int64_t, 3> count{};
    double instance = 0, slope = 1, intercept = 0;
    std::vector<float> values;
  };

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Code::file_content, "the scan \"" + name_ + "\" " + message, {{"file", name_}});
  }

  void scan(const std::vector<std::string>& paths) {
    gdcm::Scanner scanner;
    for (const gdcm::Tag& tag : {series_uid, series_number, modality, rows, columns, instance_number})
      scanner.AddTag(tag);
    scanner.Scan(paths);
    for (const std::string& path : paths) {
      if (!scanner.IsKey(path.c_str())) continue;
      const auto text = [&](const gdcm::Tag& tag) {
        const char* value = scanner.GetValue(path.c_str(), tag);
        return value ? std::string(trim(value)) : std::string();
      };
      if (text(rows).empty() || text(columns).empty()) continue;  // not an image: a directory or a report
      const auto instance = parse_number(text(instance_number));
      files_.push_back({path, text(series_uid), text(series_number), text(modality), text(columns) + " x " + text(rows),
                        instance.value_or(0)});
    }
    if (files_.empty()) fail("holds no DICOM images");
  }

  std::vector<File> chosen() const {
    std::map<std::string, std::vector<File>> series;
    for (const File& file : files_) series[file.uid].push_back(file);
    std::vector<File> found;
    for (const auto& [uid, files] : series)
      if (series.size() == 1 && choice_.empty()) found = files;
    size_t matches = found.empty() ? 0 : 1;
    for (const auto& [uid, files] : series) {
      if (choice_.empty() || (uid != choice_ && files[0].number != choice_)) continue;
      found = files;
      ++matches;
    }
    if (matches == 1) return found;
    std::string list;
    for (const auto& [uid, files] : series)
      list += (list.empty() ? "" : "; ") + ("series " + files[0].number) + ": " + files[0].kind + ", " +
              std::to_string(files.size()) + (files.size() == 1 ? " file" : " files") + " of " + files[0].size +
              ", UID " + uid;
    const std::string hint = "; choose one by series=\"" + series.begin()->second[0].number + "\" or its UID";
    fail((choice_.empty() ? "holds " + std::to_string(series.size()) + " series"
          : matches == 0  ? "holds no series \"" + choice_ + '"'
                          : "holds several series with the number " + choice_) +
         ": " + list + hint);
  }

  void read_file(const File& file) {
    gdcm::ImageReader reader;
    reader.SetFileName(file.path.c_str());
    const std::string remarks = remarks_of([&] { is_read_ = reader.Read(); });
    // The library fills truncated pixels with zeros, and only prints a remark.
    if (remarks.find("Incomplete") != std::string::npos)
      fail("cannot be read: the pixels of \"" + file.path + "\" are cut off");
    if (!is_read_) fail("cannot be read: \"" + file.path + "\" is damaged, or packed in a way that is not known");
    const gdcm::Image& image = reader.GetImage();
    Slice slice;
    slice.path = file.path;
    slice.instance = file.instance;
    const unsigned int* dimensions = image.GetDimensions();
    slice.count = {dimensions[0], dimensions[1], image.GetNumberOfDimensions() > 2 ? dimensions[2] : 1};
    const double* origin = image.GetOrigin();
    const double* direction = image.GetDirectionCosines();
    slice.place = {origin[0], origin[1], origin[2]};
    slice.directions = {Vec3{direction[0], direction[1], direction[2]}, Vec3{direction[3], direction[4], direction[5]}};
    for (unsigned int n = 0; n < 3; ++n) slice.spacing[n] = image.GetSpacing(n);
    if (image.GetPixelFormat().GetSamplesPerPixel() != 1)
      fail("has pixels in colour in \"" + file.path + "\"; export it in shades of grey");
    slice.slope = image.GetSlope();
    slice.intercept = image.GetIntercept();
    slice.values = values_of(image, file.path);
    slices_.push_back(std::move(slice));
  }

  // Returns the library's remarks during the work.
  template <class Work>
  static std::string remarks_of(const Work& work) {
    std::ostringstream stream;
    gdcm::Trace::SetStream(stream);
    gdcm::Trace::WarningOn();
    work();
    gdcm::Trace::WarningOff();
    gdcm::Trace::SetStream(std::cerr);
    return stream.str();
  }

  template <class T>
  static void convert(const std::vector<char>& bytes, double slope, double intercept, std::vector<float>& values) {
    for (size_t n = 0; n < values.size(); ++n) {
      T value;
      std::copy_n(bytes.data() + n * sizeof(T), sizeof(T), reinterpret_cast<char*>(&value));
      values[n] = static_cast<float>(slope * static_cast<double>(value) + intercept);
    }
  }

  static const auto& conversions() {
    using Format = gdcm::PixelFormat;
    static const std::map<Format::ScalarType, decltype(&convert<float>)> table{
        {Format::UINT8, convert<uint8_t>}, {Format::INT8, convert<int8_t>},     {Format::UINT16, convert<uint16_t>},
        {Format::INT16, convert<int16_t>}, {Format::UINT32, convert<uint32_t>}, {Format::INT32, convert<int32_t>},
        {Format::FLOAT32, convert<float>}, {Format::FLOAT64, convert<double>}};
    return table;
  }

  std::vector<float> values_of(const gdcm::Image& image, const std::string& path) const {
    const auto damaged = [&] { fail("cannot be read: the pixels of \"" + path + "\" are damaged or cut off"); };
    std::vector<char> bytes(image.GetBufferLength());
    if (bytes.empty() || !image.GetBuffer(bytes.data())) damaged();
    size_t count = 1;
    for (unsigned int n = 0; n < image.GetNumberOfDimensions(); ++n) count *= image.GetDimension(n);
    const gdcm::PixelFormat format = image.GetPixelFormat();
    if (bytes.size() < count * format.GetPixelSize()) damaged();
    std::vector<float> values(count);
    const double slope = image.GetSlope(), intercept = image.GetIntercept();
    if (!std::isfinite(slope) || !std::isfinite(intercept)) fail("has a scale that is not finite in \"" + path + '"');
    const auto conversion = conversions().find(format.GetScalarType());
    if (conversion == conversions().end()) fail("has pixels of a type that is not read in \"" + path + '"');
    conversion->second(bytes, slope, intercept, values);
    return values;
  }

  Vec3 normal() const { return cross(slices_[0].directions[0], slices_[0].directions[1]); }
  double height(const Slice& slice) const { return dot(slice.place, normal()); }

  void sort_slices() {
    const Slice& first = slices_[0];
    for (const Slice& slice : slices_) {
      if (slice.count != first.count || slice.count[2] != 1)
        fail("has slices of different sizes: \"" + first.path + "\" and \"" + slice.path + '"');
      constexpr double tolerance = 1e-3;
      for (size_t n = 0; n < 2; ++n)
        if (length(slice.directions[n] - first.directions[n]) > tolerance ||
            std::abs(slice.spacing[n] - first.spacing[n]) > tolerance * first.spacing[n])
          fail("has slices that lie in different ways: \"" + first.path + "\" and \"" + slice.path + '"');
    }
    std::ranges::stable_sort(slices_, [&](const Slice& a, const Slice& b) {
      const double up = height(a), other = height(b);
      return up != other ? up < other : a.instance != b.instance ? a.instance < b.instance : a.path < b.path;
    });
    drop_doubles();
    check_steps();
  }

  void drop_doubles() {
    constexpr double same_mm = 1e-4;
    std::vector<Slice> kept;
    std::string first_double;
    size_t doubles = 0;
    for (Slice& slice : slices_) {
      if (!kept.empty() && std::abs(height(slice) - height(kept.back())) < same_mm) {
        if (doubles++ == 0) first_double = slice.path;
        continue;
      }
      kept.push_back(std::move(slice));
    }
    slices_ = std::move(kept);
    if (doubles > 0)
      warnings_.push_back("the scan \"" + name_ + "\" has " + std::to_string(doubles) +
                          (doubles == 1 ? " slice" : " slices") + " twice at one place; \"" + first_double +
                          (doubles == 1 ? "\" is left out" : "\" and others are left out"));
  }

  void check_steps() const {
    if (slices_.size() < 3) return;
    std::vector<double> steps;
    for (size_t n = 1; n < slices_.size(); ++n) steps.push_back(height(slices_[n]) - height(slices_[n - 1]));
    std::vector<double> sorted = steps;
    std::ranges::sort(sorted);
    const double usual = sorted[sorted.size() / 2];
    constexpr double tolerance = 0.05;  // scanners round positions to hundredths of a millimetre
    for (size_t n = 0; n < steps.size(); ++n) {
      if (std::abs(steps[n] - usual) <= tolerance * usual) continue;
      const double missing = steps[n] / usual - 1;
      const std::string between = " between \"" + slices_[n].path + "\" and \"" + slices_[n + 1].path + '"';
      if (missing > 0.5 && std::abs(missing - std::round(missing)) <= tolerance * (missing + 1))
        fail("lacks " + std::to_string(static_cast<int>(std::round(missing))) +
             (std::round(missing) == 1 ? " slice" : " slices") + between +
             "; copy the missing files, or resample the scan");
      fail("has slices at uneven distances: " + format_rounded(steps[n], 4) + " mm" + between + ", elsewhere " +
           format_rounded(usual, 4) + " mm; resample the scan");
    }
  }

  Series finished() {
    const Slice& first = slices_.front();
    Series series;
    series.count = first.count;
    if (slices_.size() > 1) series.count[2] = static_cast<int64_t>(slices_.size());
    const Vec3 step = slices_.size() > 1
                          ? (1.0 / static_cast<double>(slices_.size() - 1)) * (slices_.back().place - first.place)
                          : first.spacing[2] * normal();
    const Vec3 across = first.spacing[0] * first.directions[0], down = first.spacing[1] * first.directions[1];
    for (int axis = 0; axis < 3; ++axis)
      series.lps_from_index.rows[static_cast<size_t>(axis)] = {across[axis], down[axis], step[axis]};
    series.lps_from_index.offset = first.place;
    series.slope = first.slope;
    series.intercept = first.intercept;
    series.warnings = warnings_;
    take_values(series);
    return series;
  }

  void take_values(Series& series) {
    const bool is_whole = std::ranges::all_of(slices_, [](const Slice& slice) {
      return std::ranges::all_of(slice.values, [](float v) {
        return v >= std::numeric_limits<int16_t>::min() && v <= std::numeric_limits<int16_t>::max() &&
               v == std::floor(v);
      });
    });
    for (Slice& slice : slices_) {
      for (const float v : slice.values)
        if (is_whole)
          series.whole.push_back(static_cast<int16_t>(v));
        else
          series.real.push_back(v);
      slice.values = {};
    }
  }

  const std::string& name_;
  const std::string& choice_;
  std::vector<File> files_;
  std::vector<Slice> slices_;
  std::vector<std::string> warnings_;
  bool is_read_ = false;
};

}  // namespace

Series read_slices(const std::string& name, const std::vector<std::string>& files, const std::string& choice) {
  return Reading(name, files, choice).read();
}

}  // namespace ombre::dicom
