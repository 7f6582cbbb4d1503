// The key of a job: what its results depend on.
#include "stores/job_key.h"

#include <algorithm>

#include "base/system/hash.h"
#include "base/text/text.h"

namespace ombre::stores {

std::optional<JobKey> JobKey::read(const Data* data) {
  if (!data || !data->list()) return std::nullopt;
  JobKey key;
  for (const Data& element : *data->list()) {
    const DataList* pair = element.list();
    if (!pair || pair->size() != 2 || !(*pair)[0].string() || !(*pair)[1].string()) return std::nullopt;
    key.parts_.push_back({*(*pair)[0].string(), *(*pair)[1].string()});
  }
  return key;
}

void JobKey::add(const std::string& name, std::string_view content) {
  parts_.push_back({name, hash_bytes(content).hex()});
}

Data JobKey::data() const {
  DataList list;
  for (const Part& part : parts_) list.emplace_back(DataList{part.name, part.hash});
  return list;
}

std::vector<std::string> JobKey::differences(const JobKey& earlier) const {
  std::vector<std::string> names;
  const auto missing_in = [&](const std::vector<Part>& parts, const std::vector<Part>& others) {
    for (const Part& part : parts)
      if (std::ranges::find(others, part) == others.end() && std::ranges::find(names, part.name) == names.end())
        names.push_back(part.name);
  };
  missing_in(parts_, earlier.parts_);
  missing_in(earlier.parts_, parts_);
  return names;
}

std::string JobKey::difference(const Data* earlier) const {
  const std::vector<std::string> changed = differences(read(earlier).value_or(JobKey()));
  if (changed.empty()) return "";
  return join(changed, ", ") + (changed.size() == 1 ? " differs" : " differ");
}

}  // namespace ombre::stores
