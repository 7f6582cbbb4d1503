#include <gdcmPixmapReader.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>

#include "base/text/error.h"
#include "base/text/text.h"
#include "dicom/dataset_values.h"
#include "dicom/gdcm_frames.h"
#include "dicom/tags.h"

namespace ombre::dicom {
namespace {

using gdcm::DataSet;
using gdcm::Tag;

const Tag samples(0x0028, 0x0002), photometric(0x0028, 0x0004), frame_count(0x0028, 0x0008),
    bits_allocated(0x0028, 0x0100), bits_stored(0x0028, 0x0101), high_bit(0x0028, 0x0102),
    representation(0x0028, 0x0103), padding_value(0x0028, 0x0120), padding_limit(0x0028, 0x0121),
    intercept(0x0028, 0x1052), slope(0x0028, 0x1053), position(0x0020, 0x0032), orientation(0x0020, 0x0037),
    pixel_spacing(0x0028, 0x0030), imager_spacing(0x0018, 0x1164), thickness(0x0018, 0x0050),
    between_slices(0x0018, 0x0088), instance_number(0x0020, 0x0013), grid_offsets(0x3004, 0x000c),
    dose_scaling(0x3004, 0x000e), segmentation_type(0x0062, 0x0001), segment_number(0x0062, 0x000b),
    shared_groups(0x5200, 0x9229), frame_groups(0x5200, 0x9230), float_pixels(0x7fe0, 0x0008),
    double_pixels(0x7fe0, 0x0009), pixels(0x7fe0, 0x0010);

// The sequences of functional groups that hold these values.
const Tag position_group(0x0020, 0x9113), orientation_group(0x0020, 0x9116), measures_group(0x0028, 0x9110),
    scale_group(0x0028, 0x9145), content_group(0x0020, 0x9111), cardiac_group(0x0018, 0x9118),
    echo_group(0x0018, 0x9114), diffusion_group(0x0018, 0x9117), segment_group(0x0062, 0x000a),
    detectors(0x0054, 0x0022);

constexpr int64_t most_frames = 1'000'000;

struct PixelKind {
  uint16_t allocated = 16, stored = 16, high = 15;
  bool is_signed = false, is_float = false;
};

class FileFrames {
 public:
  FileFrames(const std::string& name, const std::string& path) : name_(name), path_(path) {}

  std::vector<Frame> read(std::vector<std::string>& warnings) {
    open();
    const DataSet& data = this->data();
    if (binary_of<uint16_t>(data, samples).value_or(1) != 1)
      fail("has pixels in colour in \"" + path_ + "\"; export it in shades of grey");
    if (text_of(data, photometric).starts_with("PALETTE"))
      fail("has pixels in the colours of a palette in \"" + path_ + "\"; export it in shades of grey");
    width_ = binary_of<uint16_t>(data, columns).value_or(0);
    height_ = binary_of<uint16_t>(data, rows).value_or(0);
    const double frames = decimal_of(data, frame_count).value_or(1);
    if (width_ == 0 || height_ == 0) fail("has no pixels in \"" + path_ + '"');
    if (!(frames >= 0 && frames <= most_frames) || frames != std::floor(frames))
      fail("has a wrong number of frames in \"" + path_ + '"');
    count_ = std::max<int64_t>(1, static_cast<int64_t>(frames));
    shared_items_ = items_of(data, shared_groups);
    frame_items_ = items_of(data, frame_groups);
    check_groups(warnings);
    check_segmentation();
    const std::vector<double> stored = stored_values();
    std::vector<Frame> result;
    for (int64_t n = 0; n < count_; ++n) result.push_back(frame(n, stored));
    place_by_offsets(result);
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Code::file_content, "the scan \"" + name_ + "\" " + message, {{"file", name_}});
  }
  [[noreturn]] void fail_cut() const { fail("cannot be read: the pixels of \"" + path_ + "\" are damaged or cut off"); }

  const DataSet& data() const { return reader_.GetFile().GetDataSet(); }
  gdcm::TransferSyntax syntax() const { return reader_.GetFile().GetHeader().GetDataSetTransferSyntax(); }

  void open() {
    reader_.SetFileName(path_.c_str());
    bool is_read = false;
    const std::string remarks = remarks_of([&] { is_read = reader_.Read(); });
    if (!is_read) fail("cannot be read: \"" + path_ + "\" is damaged, or packed in a way that is not known");
    if (remarks.find("Incomplete") != std::string::npos)
      fail("cannot be read: the pixels of \"" + path_ + "\" are cut off");
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

  // Groups of frames that the file lacks tell nothing; frames without groups would have no place.
  void check_groups(std::vector<std::string>& warnings) const {
    const int64_t groups = frame_items_ ? static_cast<int64_t>(frame_items_->GetNumberOfItems()) : 0;
    const std::string counts = "functional groups for " + std::to_string(groups) + " frames, and " +
                               std::to_string(count_) + (count_ == 1 ? " frame" : " frames") + ", in \"" + path_ + '"';
    if (groups > 0 && groups < count_) fail("has " + counts);
    if (groups > count_) warnings.push_back("the scan \"" + name_ + "\" has " + counts + "; the first are read");
  }

  // A segmentation is one bit a pixel, or whole labels; probabilities are no labels.
  void check_segmentation() {
    const std::string kind = text_of(data(), segmentation_type);
    is_segmentation_ = text_of(data(), sop_class) == "1.2.840.10008.5.1.4.1.1.66.4";
    if (is_segmentation_ && kind == "FRACTIONAL")
      fail("is a segmentation of fractions in \"" + path_ + "\"; export it as BINARY");
    if (is_segmentation_) is_segmentation_ = kind != "LABELMAP";
  }

  PixelKind kind() const {
    PixelKind kind;
    kind.allocated = binary_of<uint16_t>(data(), bits_allocated).value_or(16);
    kind.stored = binary_of<uint16_t>(data(), bits_stored).value_or(kind.allocated);
    kind.high = binary_of<uint16_t>(data(), high_bit).value_or(static_cast<uint16_t>(kind.stored - 1));
    kind.is_signed = binary_of<uint16_t>(data(), representation).value_or(0) == 1;
    const bool is_possible = kind.allocated == 1 || kind.allocated == 8 || kind.allocated == 16 ||
                             kind.allocated == 32 || kind.allocated == 64;
    if (!is_possible || kind.stored < 1 || kind.stored > kind.allocated || kind.high >= kind.allocated ||
        kind.high + 1 < kind.stored)
      fail("has pixels of a type that is not read in \"" + path_ + '"');
    return kind;
  }

  uint64_t value_count() const { return static_cast<uint64_t>(count_) * width_ * height_; }

  std::vector<double> stored_values() {
    if (data().FindDataElement(float_pixels)) return floats<float>(bytes_of(data(), float_pixels));
    if (data().FindDataElement(double_pixels)) return floats<double>(bytes_of(data(), double_pixels));
    if (!data().FindDataElement(pixels)) fail("has no pixels in \"" + path_ + '"');
    return syntax().IsEncapsulated() ? packed_values() : plain_values();
  }

  template <class T>
  std::vector<double> floats(const std::string& bytes) const {
    if (bytes.size() / sizeof(T) < value_count()) fail_cut();
    std::vector<double> values(value_count());
    for (size_t n = 0; n < values.size(); ++n) {
      T value;
      std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
      values[n] = value;
    }
    return values;
  }

  std::vector<double> plain_values() const {
    const PixelKind kind = this->kind();
    std::string bytes = bytes_of(data(), pixels);
    const uint64_t needed = (value_count() * kind.allocated + 7) / 8;
    if (bytes.size() < needed) fail_cut();
    // The library swaps the bytes of 16-bit words; larger numbers are then still in the wrong order of words.
    if (syntax() == gdcm::TransferSyntax::ExplicitVRBigEndian && kind.allocated > 16)
      swap_words(bytes, kind.allocated / 16U);
    std::vector<double> values(value_count());
    for (size_t n = 0; n < values.size(); ++n) values[n] = plain_value(bytes, n, kind);
    return values;
  }

  static void swap_words(std::string& bytes, size_t words) {
    for (size_t at = 0; at + 2 * words <= bytes.size(); at += 2 * words)
      for (size_t n = 0; n < words / 2; ++n)
        std::swap_ranges(bytes.begin() + static_cast<ptrdiff_t>(at + 2 * n),
                         bytes.begin() + static_cast<ptrdiff_t>(at + 2 * n + 2),
                         bytes.begin() + static_cast<ptrdiff_t>(at + 2 * (words - 1 - n)));
  }

  static double plain_value(const std::string& bytes, size_t n, const PixelKind& kind) {
    if (kind.allocated == 1) return static_cast<unsigned char>(bytes[n / 8]) >> (n % 8) & 1;
    uint64_t raw = 0;
    std::memcpy(&raw, bytes.data() + n * kind.allocated / 8, kind.allocated / 8U);
    raw >>= kind.high + 1U - kind.stored;
    if (kind.stored < 64) raw &= (uint64_t{1} << kind.stored) - 1;
    const bool is_negative = kind.is_signed && (raw >> (kind.stored - 1U) & 1) != 0;
    if (!is_negative) return static_cast<double>(raw);
    const uint64_t extended = kind.stored < 64 ? raw | ~((uint64_t{1} << kind.stored) - 1) : raw;
    return static_cast<double>(static_cast<int64_t>(extended));
  }

  // The library unpacks all frames of JPEG 2000 with the bits of the first one.
  void check_precisions() const {
    constexpr size_t components = 40, precision = 42;
    const gdcm::SequenceOfFragments* fragments = data().GetDataElement(pixels).GetSequenceOfFragments();
    std::optional<char> first;
    for (size_t n = 0; fragments && n < fragments->GetNumberOfFragments(); ++n) {
      const gdcm::ByteValue* value = fragments->GetFragment(n).GetByteValue();
      if (!value || value->GetLength() <= precision) continue;
      const std::string_view bytes(value->GetPointer(), value->GetLength());
      if (!bytes.starts_with("\xFF\x4F\xFF\x51") || bytes[components + 1] != 1) continue;
      if (!first) first = bytes[precision];
      if (bytes[precision] != *first)
        fail("has frames that are packed with different numbers of bits in \"" + path_ +
             "\"; export it without packing");
    }
  }

  std::vector<double> packed_values() {
    check_precisions();
    gdcm::PixmapReader reader;
    reader.SetFileName(path_.c_str());
    bool is_read = false;
    remarks_of([&] { is_read = reader.Read(); });
    if (!is_read) fail("cannot be read: \"" + path_ + "\" is damaged, or packed in a way that is not known");
    const gdcm::Pixmap& image = reader.GetPixmap();
    std::string bytes(image.GetBufferLength(), '\0');
    bool is_unpacked = false;
    const std::string remarks = remarks_of([&] { is_unpacked = !bytes.empty() && image.GetBuffer(bytes.data()); });
    if (!is_unpacked) fail_cut();
    const gdcm::PixelFormat format = image.GetPixelFormat();
    PixelKind kind;
    kind.allocated = format.GetBitsAllocated();
    kind.stored = format.GetBitsStored();
    kind.high = format.GetHighBit();
    kind.is_signed = format.GetPixelRepresentation() == 1;
    if (format.GetSamplesPerPixel() != 1)
      fail("has pixels in colour in \"" + path_ + "\"; export it in shades of grey");
    if (bytes.size() * 8 < value_count() * kind.allocated) fail_cut();
    std::vector<double> values(value_count());
    for (size_t n = 0; n < values.size(); ++n) values[n] = plain_value(bytes, n, kind);
    return values;
  }

  // Returns the group of a frame, which all frames may share; or null.
  const DataSet* group(int64_t n, const Tag& sequence) {
    if (frame_items_ && frame_items_->GetNumberOfItems() > 0)
      if (const DataSet* found =
              first_item(frame_items_->GetItem(static_cast<size_t>(n + 1)).GetNestedDataSet(), sequence, keeper_))
        return found;
    if (shared_items_ && shared_items_->GetNumberOfItems() > 0)
      return first_item(shared_items_->GetItem(1).GetNestedDataSet(), sequence, keeper_);
    return nullptr;
  }

  // Returns the group's data set if it has the element, else that of the file.
  const DataSet& holder(int64_t n, const Tag& sequence, const Tag& tag) {
    const DataSet* found = group(n, sequence);
    return found && found->FindDataElement(tag) ? *found : data();
  }

  std::vector<double> decimals(int64_t n, const Tag& sequence, const Tag& tag) {
    return decimals_of(holder(n, sequence, tag), tag);
  }

  // Returns a place or an orientation; files of nuclear medicine give those of their detector.
  std::vector<double> placement(int64_t n, const Tag& sequence, const Tag& tag) {
    std::vector<double> numbers = decimals(n, sequence, tag);
    if (!numbers.empty()) return numbers;
    const DataSet* detector = first_item(data(), detectors, keeper_);
    return detector ? decimals_of(*detector, tag) : numbers;
  }

  Frame frame(int64_t n, const std::vector<double>& stored) {
    Frame frame;
    frame.path = path_;
    frame.number = n;
    frame.count = {width_, height_};
    frame.instance = decimal_of(data(), instance_number).value_or(0);
    read_place(n, frame);
    read_phase(n, frame);
    if (is_segmentation_) frame.segment = read_segment(n);
    read_values(n, stored, frame);
    return frame;
  }

  void read_place(int64_t n, Frame& frame) {
    if (const auto numbers = placement(n, position_group, position); numbers.size() == 3) {
      frame.place = {numbers[0], numbers[1], numbers[2]};
      frame.has_place = true;
    }
    if (const auto numbers = placement(n, orientation_group, orientation); numbers.size() == 6)
      frame.directions = {Vec3{numbers[0], numbers[1], numbers[2]}, Vec3{numbers[3], numbers[4], numbers[5]}};
    for (Vec3& direction : frame.directions) {
      const double size = length(direction);
      if (!(std::abs(size - 1) < 0.01)) fail("has a wrong orientation in \"" + path_ + '"');
      direction = (1 / size) * direction;
    }
    auto spacing = decimals(n, measures_group, pixel_spacing);
    if (spacing.size() != 2) spacing = decimals_of(data(), imager_spacing);
    frame.has_spacing = spacing.size() == 2 && spacing[0] > 0 && spacing[1] > 0;
    if (frame.has_spacing) frame.spacing = {spacing[1], spacing[0]};  // the file gives that of rows first
    const auto between = decimals(n, measures_group, between_slices), thick = decimals(n, measures_group, thickness);
    frame.step = !between.empty() && between[0] != 0 ? std::abs(between[0]) : thick.empty() ? 0 : std::abs(thick[0]);
  }

  template <class T>
  std::optional<double> binary(int64_t n, const Tag& sequence, const Tag& tag) {
    const auto value = binary_of<T>(holder(n, sequence, tag), tag);
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
  }

  void read_phase(int64_t n, Frame& frame) {
    const auto number = [&](std::optional<double> first, const Tag& other) {
      if (first) return *first;
      return decimal_of(data(), other).value_or(std::numeric_limits<double>::quiet_NaN());
    };
    frame.phase[temporal_position] =
        number(binary<uint32_t>(n, content_group, Tag(0x0020, 0x9128)), Tag(0x0020, 0x0100));
    frame.phase[trigger_time] = number(binary<double>(n, cardiac_group, Tag(0x0020, 0x9153)), Tag(0x0018, 0x1060));
    frame.phase[echo_time] = number(binary<double>(n, echo_group, Tag(0x0018, 0x9082)), Tag(0x0018, 0x0081));
    frame.phase[b_value] = number(binary<double>(n, diffusion_group, Tag(0x0018, 0x9087)), Tag(0x0018, 0x0019));
    frame.phase[acquisition] = number(binary<uint16_t>(n, content_group, Tag(0x0020, 0x9156)), Tag(0x0020, 0x0012));
  }

  int64_t read_segment(int64_t n) {
    return static_cast<int64_t>(binary<uint16_t>(n, segment_group, segment_number).value_or(1));
  }

  void read_values(int64_t n, const std::vector<double>& stored, Frame& frame) {
    const auto slopes = decimals(n, scale_group, slope), intercepts = decimals(n, scale_group, intercept);
    frame.slope = slopes.empty() ? decimal_of(data(), dose_scaling).value_or(1) : slopes[0];
    frame.intercept = intercepts.empty() ? 0 : intercepts[0];
    if (!std::isfinite(frame.slope) || !std::isfinite(frame.intercept))
      fail("has a scale that is not finite in \"" + path_ + '"');
    const auto padding = padding_range();
    const size_t size = size_t{width_} * height_;
    frame.values.reserve(size);
    for (size_t k = 0; k < size; ++k) {
      const double value = stored[static_cast<size_t>(n) * size + k];
      if (padding && value >= padding->first && value <= padding->second)
        frame.padding.push_back(static_cast<uint32_t>(k));
      frame.values.push_back(static_cast<float>(frame.slope * value + frame.intercept));
    }
  }

  // Returns the range of stored numbers that mean that nothing was scanned there.
  std::optional<std::pair<double, double>> padding_range() const {
    const auto number = [&](const Tag& tag) -> std::optional<double> {
      const auto value = binary_of<uint16_t>(data(), tag);
      if (!value) return std::nullopt;
      const bool is_signed = binary_of<uint16_t>(data(), representation).value_or(0) == 1;
      return is_signed ? static_cast<double>(static_cast<int16_t>(*value)) : static_cast<double>(*value);
    };
    const auto value = number(padding_value);
    if (!value) return std::nullopt;
    const double limit = number(padding_limit).value_or(*value);
    return std::pair(std::min(*value, limit), std::max(*value, limit));
  }

  // Frames without places of their own follow the first: by the offsets of doses, else by the distance between slices.
  void place_by_offsets(std::vector<Frame>& frames) const {
    if (frame_items_ && frame_items_->GetNumberOfItems() > 0) return;
    if (frames.size() < 2) return;
    const Vec3 normal = cross(frames[0].directions[0], frames[0].directions[1]);
    const std::vector<double> offsets = decimals_of(data(), grid_offsets);
    if (!offsets.empty() && offsets.size() != frames.size())
      fail("has offsets for " + std::to_string(offsets.size()) + " of its " + std::to_string(frames.size()) +
           " frames in \"" + path_ + '"');
    const bool is_downwards = decimal_of(data(), between_slices).value_or(0) < 0;  // in nuclear medicine
    for (size_t n = 1; n < frames.size(); ++n) {
      const double step = is_downwards ? -frames[n].step : frames[n].step;
      const double offset = offsets.empty() ? static_cast<double>(n) * step : offsets[n] - offsets[0];
      frames[n].place = frames[0].place + offset * normal;
      if (offsets.empty() && frames[n].step == 0) frames[n].has_place = false;
    }
    if (!frames.back().has_place) frames.front().has_place = false;
  }

  const std::string& name_;
  const std::string& path_;
  gdcm::Reader reader_;
  uint32_t width_ = 0, height_ = 0;
  int64_t count_ = 1;
  bool is_segmentation_ = false;
  gdcm::SmartPointer<gdcm::SequenceOfItems> shared_items_, frame_items_, keeper_;
};

}  // namespace

std::vector<Frame> read_frames(const std::string& name, const std::string& path, std::vector<std::string>& warnings) {
  return FileFrames(name, path).read(warnings);
}

}  // namespace ombre::dicom
