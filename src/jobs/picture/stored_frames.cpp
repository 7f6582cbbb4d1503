#include "jobs/picture/stored_frames.h"

#include <charconv>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr std::string_view frames_format = "ombre frames";

std::string name_of(int64_t frame, int count) { return "frame_" + frame_number(frame, count) + ".png"; }

bool is_frame(std::string_view name, int count) {
  constexpr size_t prefix = std::string_view("frame_").size();
  int frame = -1;
  if (name.size() > prefix) std::from_chars(name.data() + prefix, name.data() + name.size(), frame);
  return frame >= 0 && frame < count && name == name_of(frame, count);
}

}  // namespace

std::string frame_number(int64_t frame, int count) {
  const size_t digits = std::to_string(count - 1).size();
  std::string number = std::to_string(frame);
  number.insert(0, digits - number.size(), '0');
  return number;
}

const stores::JobWords& frame_words() {
  static const stores::JobWords words{"set of frames", "frames", "frames.json", "frame", ".png"};
  return words;
}

std::string StoredFrames::file_name(int64_t frame) const { return name_of(frame, count_); }

std::string StoredFrames::description(const stores::Entries& finished) const {
  return print_json(DataMembers{{"format", std::string(frames_format) + ", version 1"},
                                {"frames", number(count_)},
                                {"status", is_complete(finished) ? "complete" : "unfinished"},
                                {"key", key_.data()}});
}

void StoredFrames::check_same(const std::string& folder, const DataMembers& there) const {
  const std::string difference = key_.difference(Data(there).find("key"));
  if (difference.empty()) return;
  throw Error(Code::other_job,
              folder + " holds other frames, since " + difference + "; replace them with " +
                  spelled::option("--force") + ", or choose another folder",
              {{"file", folder}});
}

bool StoredFrames::accepts(const stores::Entry& entry) const {
  return entry.id < count_ && entry.files.size() == 1 && entry.files[0].name == file_name(entry.id);
}

bool StoredFrames::owns(std::string_view name) const { return is_frame(name, count_); }

bool StoredFrames::is_kind(const Data& description) const {
  const Data* format = description.find("format");
  return format && format->string() && format->string()->starts_with(frames_format);
}

std::optional<stores::NameTest> StoredFrames::files_of(const Data& description) const {
  constexpr uint64_t most_frames = 100'000;
  const auto count = stores::whole_number(description.find("frames"));
  if (!count || *count > most_frames) return std::nullopt;
  return [count](std::string_view name) { return is_frame(name, static_cast<int>(*count)); };
}

}  // namespace ombre::compile
