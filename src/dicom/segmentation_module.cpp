#include "dicom/segmentation.h"

#include <gdcmReader.h>

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "dicom/dataset_values.h"

namespace ombre::dicom {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& message) {
  throw Error(Code::file_content, "the scan \"" + name + "\" " + message, {{"file", name}});
}

// Returns the distance between slices: what the file says, else the least between its frames.
double step_of(const std::vector<Frame>& frames) {
  constexpr double same_mm = 1e-3;
  double least = 0;
  for (size_t n = 1; n < frames.size(); ++n) {
    const double step = height(frames[n]) - height(frames[n - 1]);
    if (step > same_mm && (least == 0 || step < least)) least = step;
  }
  const double stated = frames[0].step;
  constexpr double tolerance = 0.05;
  const double times = stated > 0 ? least / stated : 0;
  const bool is_stated =
      stated > 0 && (least == 0 || (times > 1 - tolerance && std::abs(times - std::round(times)) < tolerance));
  return is_stated ? stated : least > 0 ? least : 1;
}

void add_labels(const std::string& name, const Frame& frame, Frame& slice) {
  for (size_t n = 0; n < frame.values.size(); ++n) {
    if (frame.values[n] == 0) continue;
    float& label = slice.values[n];
    if (label != 0 && label != static_cast<float>(frame.segment))
      fail(name, "has segments that overlap, the numbers " + std::to_string(static_cast<int64_t>(label)) + " and " +
                     std::to_string(frame.segment) +
                     "; choose one by segment=\"...\" or label=" + std::to_string(frame.segment));
    label = static_cast<float>(frame.segment);
  }
}

}  // namespace

std::array<double, 3> colour_of_lab(const std::array<double, 3>& stored) {
  constexpr double greatest = 65535;
  const double l = stored[0] / greatest * 100, a = stored[1] / greatest * 255 - 128,
               b = stored[2] / greatest * 255 - 128;
  const auto cube = [](double t) { return t > 6.0 / 29 ? t * t * t : 3 * (6.0 / 29) * (6.0 / 29) * (t - 4.0 / 29); };
  const double y = (l + 16) / 116;
  const double xyz[] = {0.96422 * cube(y + a / 500), cube(y), 0.82521 * cube(y - b / 200)};
  // The matrix leads from XYZ at D50 to linear sRGB, adapted by Bradford's method (B. Lindbloom).
  constexpr double matrix[3][3] = {
      {3.1338561, -1.6168667, -0.4906146}, {-0.9787684, 1.9161415, 0.0334540}, {0.0719453, -0.2289914, 1.4052427}};
  std::array<double, 3> colour{};
  for (size_t n = 0; n < 3; ++n) {
    const double linear = std::clamp(matrix[n][0] * xyz[0] + matrix[n][1] * xyz[1] + matrix[n][2] * xyz[2], 0.0, 1.0);
    colour[n] = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  }
  return colour;
}

std::vector<Segment> segments_of_file(const std::string& name, const std::string& file) {
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.Read()) fail(name, "cannot be read: \"" + file + "\" is damaged, or packed in a way that is not known");
  const auto items = items_of(reader.GetFile().GetDataSet(), gdcm::Tag(0x0062, 0x0002));
  std::vector<Segment> segments;
  for (size_t n = 1; items && n <= items->GetNumberOfItems(); ++n) {
    const gdcm::DataSet& item = items->GetItem(n).GetNestedDataSet();
    Segment segment{text_of(item, gdcm::Tag(0x0062, 0x0005)),
                    binary_of<uint16_t>(item, gdcm::Tag(0x0062, 0x0004)).value_or(static_cast<uint16_t>(n))};
    if (segment.name.empty()) segment.name = "segment " + std::to_string(segment.label);
    const std::string lab = bytes_of(item, gdcm::Tag(0x0062, 0x000d));
    if (lab.size() >= 3 * sizeof(uint16_t)) {
      std::array<uint16_t, 3> stored{};
      std::memcpy(stored.data(), lab.data(), sizeof stored);
      segment.colour = colour_of_lab(
          {static_cast<double>(stored[0]), static_cast<double>(stored[1]), static_cast<double>(stored[2])});
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

std::vector<Frame> label_slices(const std::string& name, std::vector<Frame> frames, int64_t label) {
  std::ranges::stable_sort(frames, {}, height);
  const double step = step_of(frames), first = height(frames.front());
  constexpr double most_slices = 100'000, tolerance = 0.1;
  const double count = std::round((height(frames.back()) - first) / step) + 1;
  if (!(count <= most_slices)) fail(name, "has frames that lie too far apart");
  std::vector<Frame> slices(static_cast<size_t>(count), frames.front());
  const Vec3 normal = cross(frames[0].directions[0], frames[0].directions[1]);
  for (size_t n = 0; n < slices.size(); ++n) {
    slices[n].place = frames.front().place + static_cast<double>(n) * step * normal;
    slices[n].step = step;
    slices[n].padding.clear();
    std::ranges::fill(slices[n].values, 0.0F);
  }
  for (const Frame& frame : frames) {
    const double at = (height(frame) - first) / step;
    const Frame& slice = slices[static_cast<size_t>(std::round(at))];
    if (length(frame.place - slice.place) > tolerance * step)
      fail(name, "has frames that do not lie on even slices; export it from the scan that it belongs to");
    if (label < 0 || frame.segment == label) add_labels(name, frame, slices[static_cast<size_t>(std::round(at))]);
  }
  return slices;
}

}  // namespace ombre::dicom
