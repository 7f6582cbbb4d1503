#include "stores/stored_job.h"

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/phrase.h"

namespace ombre::stores {

bool StoredJob::is_kind(const Data& description) const {
  const Data* format = description.find("format");
  return format && format->string() && format->string()->starts_with(words().format);
}

void KeyedJob::check_same(const std::string& folder, const DataMembers& there) const {
  const std::string differing = difference(there);
  if (differing.empty()) return;
  throw Error(Code::other_job,
              folder + " holds another " + words().kind + ", since " + differing + "; replace it with " +
                  spelled::option("--force") + ", or choose another folder",
              {{"file", folder}});
}

std::string KeyedJob::described(DataMembers members) const {
  members.emplace(members.begin(), "format", words().format + ", version 1");
  members.emplace_back("key", key_.data());
  return print_json(members);
}

std::string piece_number(int64_t number, int64_t count) {
  const size_t digits = std::to_string(count - 1).size();
  std::string text = std::to_string(number);
  text.insert(0, digits - text.size(), '0');
  return text;
}

}  // namespace ombre::stores
