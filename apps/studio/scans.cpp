#include "studio/scans.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/text/error.h"
#include "sources/file_store.h"
#include "sources/volume_file_parts.h"
#include "studio/design_answer.h"

namespace ombre::studio {
namespace {

constexpr int64_t most_side = 1024;  // numbers of a plane along each axis

double number_at(const formats::VoxelVolume& volume, const std::array<int64_t, 3>& at) {
  const int64_t n = (at[2] * volume.count[1] + at[1]) * volume.count[0] + at[0];
  return formats::visit_numbers(
      volume, [&](const auto& numbers) { return static_cast<double>(numbers[static_cast<size_t>(n)]); });
}

// Returns the time of the file's last change, so that another scan under its name is read again.
std::string stamp_of(const std::filesystem::path& path) {
  std::error_code error;
  return std::to_string(std::filesystem::last_write_time(path, error).time_since_epoch().count());
}

// Returns the lengths of a voxel's sides; ones if the file does not state them.
DataList steps_of(const formats::VoxelVolume& volume) {
  DataList steps;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& map = volume.space_from_index;
    steps.emplace_back(map ? length(Vec3{map->rows[0][axis], map->rows[1][axis], map->rows[2][axis]}) : 1.0);
  }
  return steps;
}

}  // namespace

Scan read_scan(const std::string& path, const formats::VolumeChoice& choice, const StopFlag* stop) {
  sources::FileStore files;
  const sources::ReadFile read = [&](const std::string& file) { return files.view(file, files.content(file)); };
  std::vector<std::string> warnings;  // ignored here: the design that reads the scan reports them
  Scan scan;
  scan.volume = sources::read_volume_parts(path, sources::volume_parts(path, read), choice, read, stop, warnings);
  scan.range = sources::value_range(scan.volume);
  scan.shown = sources::shown_range(scan.volume);
  scan.otsu = sources::otsu_level(scan.volume);
  return scan;
}

ScanPtr Scans::find(const Request& request, const StopFlag& stop) {
  const std::string& name = request.text("file");
  const std::filesystem::path path = workspace_.path(name);
  formats::VolumeChoice choice{request.text("series", ""), -1};
  if (request.body.find("channel")) choice.channel = static_cast<int>(request.whole("channel", -1, 100000));
  const std::string key =
      stamp_of(path) + ' ' + std::to_string(choice.channel) + ' ' + choice.name + '\n' + path.string();
  // The planes of one scan are requested together, so the first request reads it while the others wait.
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find(kept_, key, [](const auto& entry) -> const std::string& { return entry.first; });
  if (known != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, known);
    return kept_.front().second;
  }
  kept_.emplace_front(key, std::make_shared<const Scan>(read_scan(path.string(), choice, &stop)));
  if (kept_.size() > most) kept_.pop_back();
  return kept_.front().second;
}

Answer Scans::describe(const Request& request, const StopFlag& stop) {
  const ScanPtr scan = find(request, stop);
  DataList count;
  for (const int64_t n : scan->volume.count) count.emplace_back(number(n));
  return {{{"count", std::move(count)},
           {"steps_mm", steps_of(scan->volume)},
           {"has_place", scan->volume.space_from_index.has_value()},
           {"space", std::string(formats::name(scan->volume.space))},
           {"type", scan->volume.type},
           {"channels", number(scan->volume.channels)},
           {"least", scan->range.lo},
           {"greatest", scan->range.hi},
           {"shown", DataList{scan->shown.lo, scan->shown.hi}},
           {"otsu", scan->otsu}},
          {}};
}

Answer Scans::plane(const Request& request, const StopFlag& stop) {
  const ScanPtr scan = find(request, stop);
  const auto& count = scan->volume.count;
  const auto across = static_cast<size_t>(request.whole("axis", 0, 2));
  const size_t right = across == 0 ? 1 : 0, up = across == 2 ? 1 : 2;
  std::array<int64_t, 3> at{};
  at[across] = request.whole("index", 0, count[across] - 1);
  const int64_t step = (std::max(count[right], count[up]) + most_side - 1) / most_side;
  const int64_t width = (count[right] + step - 1) / step, height = (count[up] + step - 1) / step;
  std::vector<float> numbers;
  numbers.reserve(static_cast<size_t>(width * height));
  for (int64_t row = 0; row < height; ++row)
    for (int64_t column = 0; column < width; ++column) {
      at[right] = column * step;
      at[up] = row * step;
      numbers.push_back(static_cast<float>(number_at(scan->volume, at)));
    }
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return {{{"width", number(width)}, {"height", number(height)}, {"step", number(step)}}, std::move(bytes)};
}

Answer Scans::voxel(const Request& request, const StopFlag& stop) {
  const ScanPtr scan = find(request, stop);
  const std::vector<double> place = request.numbers("at", 3);
  std::array<int64_t, 3> at{};
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(place[axis] >= 0 && place[axis] < static_cast<double>(scan->volume.count[axis])))
      throw RequestError("request", "\"at\" is the number of a voxel, [i, j, k], from 0 on along each axis");
    at[axis] = static_cast<int64_t>(place[axis]);
  }
  DataMembers members{{"value", number_at(scan->volume, at)}};
  if (const auto& map = scan->volume.space_from_index) {
    const Vec3 index{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    members.emplace_back("at_mm", list_of((*map)(index)));
  }
  return {std::move(members), {}};
}

}  // namespace ombre::studio
