#include "dicom/phases.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::dicom {
namespace {

constexpr std::string_view key_names[] = {"temporal position", "trigger time", "echo time", "b-value", "acquisition"};

using Place = std::vector<Frame>;

std::vector<Place> places_of(std::vector<Frame> frames) {
  constexpr double same_mm = 1e-4;
  std::vector<Place> places;
  for (Frame& frame : frames) {
    if (places.empty() || height(frame) - height(places.back().front()) >= same_mm) places.emplace_back();
    places.back().push_back(std::move(frame));
  }
  return places;
}

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Returns the keys that differ at one place; keys that differ between places alone tell nothing.
std::vector<size_t> telling_keys(const std::vector<Place>& places) {
  std::vector<size_t> keys;
  for (size_t key = 0; key < phase_keys; ++key) {
    const auto differs = [&](const Place& place) {
      return std::ranges::any_of(place,
                                 [&](const Frame& f) { return !is_same(f.phase[key], place.front().phase[key]); });
    };
    if (std::ranges::any_of(places, differs)) keys.push_back(key);
  }
  return keys;
}

bool is_before(const Frame& a, const Frame& b, const std::vector<size_t>& keys) {
  for (const size_t key : keys) {
    if (is_same(a.phase[key], b.phase[key])) continue;
    if (std::isnan(a.phase[key]) || std::isnan(b.phase[key])) return std::isnan(a.phase[key]);
    return a.phase[key] < b.phase[key];
  }
  return a.instance != b.instance ? a.instance < b.instance : a.path != b.path ? a.path < b.path : a.number < b.number;
}

bool is_double(const Frame& a, const Frame& b, const std::vector<size_t>& keys) {
  return std::ranges::all_of(keys, [&](size_t key) { return is_same(a.phase[key], b.phase[key]); });
}

// Sorts the frames at a place, and leaves out those that no key tells from another.
void sort_place(Place& place, const std::vector<size_t>& keys, PhaseResult& result) {
  std::ranges::stable_sort(place, [&](const Frame& a, const Frame& b) { return is_before(a, b, keys); });
  Place kept;
  for (Frame& frame : place) {
    if (kept.empty() || !is_double(kept.back(), frame, keys)) {
      kept.push_back(std::move(frame));
      continue;
    }
    if (result.doubles++ == 0) result.first_double = frame.path;
  }
  place = std::move(kept);
}

std::string text_of_phase(const Frame& frame, const std::vector<size_t>& keys) {
  std::string text;
  for (const size_t key : keys)
    text += (text.empty() ? "" : ", ") + std::string(key_names[key]) + ' ' +
            (std::isnan(frame.phase[key]) ? "none" : format_rounded(frame.phase[key], 6));
  return text;
}

std::string list_of_phases(const Place& place, const std::vector<size_t>& keys) {
  constexpr size_t most_listed = 20;
  std::string text;
  for (size_t n = 0; n < std::min(place.size(), most_listed); ++n)
    text += (n > 0 ? "; " : "") + std::string("phase=") + std::to_string(n + 1) + ": " + text_of_phase(place[n], keys);
  return text + (place.size() > most_listed ? " and more" : "");
}

}  // namespace

PhaseResult frames_of_phase(const std::string& name, std::vector<Frame> frames, int phase) {
  const auto fail = [&](const std::string& message) {
    throw Error(Code::file_content, "the scan \"" + name + "\" " + message, {{"file", name}});
  };
  std::vector<Place> places = places_of(std::move(frames));
  std::vector<size_t> keys = telling_keys(places);
  PhaseResult result;
  for (Place& place : places) sort_place(place, keys, result);
  const auto [least, most] = std::ranges::minmax_element(places, {}, [](const Place& place) { return place.size(); });
  const size_t count = most->size();
  // A slice that was scanned again is a double, not a phase.
  const bool is_repeated = least->size() == 1 && keys == std::vector<size_t>{acquisition};
  if (least->size() != count && !is_repeated)
    fail("holds " + std::to_string(count) + " volumes at some places and " + std::to_string(least->size()) +
         " at others: " + list_of_phases(*most, keys) + "; put the files of one volume into a folder of their own");
  const bool has_phases = count > 1 && !is_repeated;
  if (has_phases && phase == 0)
    fail("holds " + std::to_string(count) + " volumes at the same places: " + list_of_phases(*most, keys) +
         "; choose one by phase=1, up to " + std::to_string(count));
  const size_t phases = has_phases ? count : 1;
  if (phase > static_cast<int>(phases))
    fail("has no phase " + std::to_string(phase) + "; 1 " +
         (has_phases ? "to " + std::to_string(phases) + " are" : "is") + " there");
  for (Place& place : places) {
    if (is_repeated && place.size() > 1 && result.doubles == 0) result.first_double = place[1].path;
    if (is_repeated) result.doubles += place.size() - 1;
    result.frames.push_back(std::move(place[static_cast<size_t>(std::max(phase, 1) - 1)]));
  }
  return result;
}

}  // namespace ombre::dicom
