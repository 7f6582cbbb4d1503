// DICOM files that are put together byte by byte: part 10 of the standard describes their beginning, part 5 the
// encoding, part 6 the tags, part 3 what they mean.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/system/module_loader.h"
#include "base/text/error.h"
#include "dicom/series.h"

namespace ombre::dicom {

namespace fs = std::filesystem;

using Tag = std::pair<uint16_t, uint16_t>;

// Elements in the order of their tags, each with its kind ("US") and its value; texts are padded when they are written.
using Elements = std::map<Tag, std::pair<std::string, std::string>>;

constexpr Tag series_uid{0x0020, 0x000e}, series_number{0x0020, 0x0011}, instance_number{0x0020, 0x0013},
    position{0x0020, 0x0032}, orientation{0x0020, 0x0037}, samples{0x0028, 0x0002}, photometric{0x0028, 0x0004},
    rows{0x0028, 0x0010}, columns{0x0028, 0x0011}, pixel_spacing{0x0028, 0x0030}, bits_allocated{0x0028, 0x0100},
    bits_stored{0x0028, 0x0101}, high_bit{0x0028, 0x0102}, is_signed{0x0028, 0x0103}, intercept{0x0028, 0x1052},
    slope{0x0028, 0x1053}, pixels{0x7fe0, 0x0010};

inline std::string little(uint32_t value, size_t size) {
  std::string bytes;
  for (size_t n = 0; n < size; ++n) bytes += static_cast<char>(value >> (8 * n) & 255U);
  return bytes;
}

inline std::pair<std::string, std::string> number(uint32_t value) { return {"US", little(value, 2)}; }

inline std::string encoded(const Elements& elements) {
  std::string bytes;
  for (const auto& [tag, element] : elements) {
    auto [kind, value] = element;
    if (value.size() % 2 == 1) value += kind == "UI" || kind == "OB" ? '\0' : ' ';
    const bool is_long = kind == "OB" || kind == "OW" || kind == "SQ";
    bytes += little(tag.first, 2) + little(tag.second, 2) + kind;
    bytes += is_long ? little(0, 2) + little(static_cast<uint32_t>(value.size()), 4)
                     : little(static_cast<uint32_t>(value.size()), 2);
    bytes += value;
  }
  return bytes;
}

// Returns the value of a sequence of items.
inline std::pair<std::string, std::string> sequence(const std::vector<Elements>& items) {
  std::string bytes;
  for (const Elements& item : items) {
    const std::string content = encoded(item);
    bytes += little(0xfffe, 2) + little(0xe000, 2) + little(static_cast<uint32_t>(content.size()), 4) + content;
  }
  return {"SQ", bytes};
}

// Returns a file: 128 bytes of any kind, "DICM", what describes the file, and the elements.
inline std::string file_of(const Elements& elements) {
  const std::string about = encoded({{{0x0002, 0x0001}, {"OB", std::string("\0\1", 2)}},
                                     {{0x0002, 0x0002}, {"UI", "1.2.840.10008.5.1.4.1.1.2"}},
                                     {{0x0002, 0x0003}, {"UI", "1.2.3.4"}},
                                     {{0x0002, 0x0010}, {"UI", "1.2.840.10008.1.2.1"}},
                                     {{0x0002, 0x0012}, {"UI", "1.2.3"}}});
  const Elements length{{{0x0002, 0x0000}, {"UL", little(static_cast<uint32_t>(about.size()), 4)}}};
  return std::string(128, '\0') + "DICM" + encoded(length) + about + encoded(elements);
}

inline std::string words(const std::vector<int16_t>& values) {
  return {reinterpret_cast<const char*>(values.data()), 2 * values.size()};
}

// A slice of two columns and one row of 0.25 mm x 0.5 mm at a height; CT has Hounsfield units of 16 bits.
inline Elements slice(double height, const std::vector<int16_t>& values) {
  return {{{0x0008, 0x0016}, {"UI", "1.2.840.10008.5.1.4.1.1.2"}},
          {{0x0008, 0x0018}, {"UI", "1.2.3.4." + std::to_string(static_cast<int>(100 * (height + 50)))}},
          {{0x0008, 0x0060}, {"CS", "CT"}},
          {{0x0018, 0x0050}, {"DS", "1"}},
          {series_uid, {"UI", "1.2.3.9"}},
          {series_number, {"IS", "4"}},
          {instance_number, {"IS", "1"}},
          {position, {"DS", "-10\\20\\" + std::to_string(height)}},
          {orientation, {"DS", "1\\0\\0\\0\\1\\0"}},
          {samples, number(1)},
          {photometric, {"CS", "MONOCHROME2"}},
          {rows, number(1)},
          {columns, number(2)},
          {pixel_spacing, {"DS", "0.5\\0.25"}},
          {bits_allocated, number(16)},
          {bits_stored, number(16)},
          {high_bit, number(15)},
          {is_signed, number(1)},
          {intercept, {"DS", "-1024"}},
          {slope, {"DS", "2"}},
          {pixels, {"OW", words(values)}}};
}

class Dicom : public testing::Test {
 protected:
  Dicom() : folder_(fs::path(testing::TempDir()) / ("dicom_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Dicom() override { fs::remove_all(folder_); }
  void SetUp() override {
    if (!has_module(*file_format().module)) GTEST_SKIP() << "no DICOM in this build";
  }

  void put(const std::string& bytes) {
    files_.push_back((folder_ / ("file" + std::to_string(files_.size()))).string());
    std::ofstream(files_.back(), std::ios::binary) << bytes;
  }
  void put(const Elements& elements) { put(file_of(elements)); }

  Series read(const SeriesChoice& choice = {}, const StopFlag* stop = nullptr) const {
    return read_series("scan", files_, choice, stop);
  }
  std::string failure(const SeriesChoice& choice = {}) const {
    try {
      read(choice);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
  std::vector<std::string> files_;
};

}  // namespace ombre::dicom
