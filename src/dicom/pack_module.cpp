#include "dicom/volume_pack.h"

#include <cstring>

namespace ombre::dicom {
namespace {

template <class T>
void put(std::string& bytes, const T* values, size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class T>
void take(std::string_view& bytes, T* values, size_t count) {
  if (count == 0) return;
  std::memcpy(values, bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
}

template <class T>
void put_list(std::string& bytes, const std::vector<T>& list) {
  const uint64_t count = list.size();
  put(bytes, &count, 1);
  put(bytes, list.data(), list.size());
}

template <class T>
void take_list(std::string_view& bytes, std::vector<T>& list) {
  uint64_t count = 0;
  take(bytes, &count, 1);
  list.resize(count);
  take(bytes, list.data(), list.size());
}

// Calls `each` with the address and the count of all numbers that every series has.
template <class AnySeries, class Each>
void each_number(AnySeries& series, const Each& each) {
  each(series.count.data(), series.count.size());
  each(series.lps_from_index.rows.data(), 3);
  each(&series.lps_from_index.offset, 1);
  each(&series.slope, 1);
  each(&series.intercept, 1);
  each(&series.has_lengths, 1);
  each(&series.padding, 1);
}

}  // namespace

std::string pack(const Series& series) {
  std::string bytes, warnings;
  each_number(series, [&](const auto* values, size_t count) { put(bytes, values, count); });
  for (const std::string& warning : series.warnings) warnings += warning + '\n';
  put_list(bytes, std::vector<char>(warnings.begin(), warnings.end()));
  put_list(bytes, series.whole);
  put_list(bytes, series.real);
  return bytes;
}

Series unpack(std::string_view bytes) {
  Series series;
  each_number(series, [&](auto* values, size_t count) { take(bytes, values, count); });
  std::vector<char> warnings;
  take_list(bytes, warnings);
  std::string line;
  for (const char c : warnings) {
    if (c != '\n') {
      line += c;
      continue;
    }
    series.warnings.push_back(line);
    line.clear();
  }
  take_list(bytes, series.whole);
  take_list(bytes, series.real);
  return series;
}

std::string pack_segments(const std::vector<Segment>& segments) {
  std::string bytes;
  const uint64_t count = segments.size();
  put(bytes, &count, 1);
  for (const Segment& segment : segments) {
    put_list(bytes, std::vector<char>(segment.name.begin(), segment.name.end()));
    put(bytes, &segment.label, 1);
    const bool has_colour = segment.colour.has_value();
    const std::array<double, 3> colour = segment.colour.value_or(std::array<double, 3>{});
    put(bytes, &has_colour, 1);
    put(bytes, colour.data(), colour.size());
  }
  return bytes;
}

std::vector<Segment> unpack_segments(std::string_view bytes) {
  uint64_t count = 0;
  take(bytes, &count, 1);
  std::vector<Segment> segments(count);
  for (Segment& segment : segments) {
    std::vector<char> name;
    take_list(bytes, name);
    segment.name.assign(name.begin(), name.end());
    take(bytes, &segment.label, 1);
    bool has_colour = false;
    std::array<double, 3> colour{};
    take(bytes, &has_colour, 1);
    take(bytes, colour.data(), colour.size());
    if (has_colour) segment.colour = colour;
  }
  return segments;
}

}  // namespace ombre::dicom
