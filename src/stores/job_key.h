// The key of a job: what its results depend on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"

namespace ombre::stores {

// Lists the parts that a job's results depend on, such as its design, the files that it reads, options and the version
// of the program: each with a name for messages and the hash of its content. Jobs with equal results have equal keys.
class JobKey {
 public:
  // Reads what `data` returned; nothing if it is not a key.
  static std::optional<JobKey> read(const Data* data);

  void add(const std::string& name, std::string_view content);

  // Returns a list of pairs, [name, hash].
  Data data() const;
  // Returns the names of the parts in which an earlier key differs, each once: first those of this one.
  std::vector<std::string> differences(const JobKey& earlier) const;
  // Returns "part.vcad, --size differ" for an earlier key as data, which may be null; "" if the keys are equal.
  std::string difference(const Data* earlier) const;

  bool operator==(const JobKey&) const = default;

 private:
  struct Part {
    std::string name, hash;
    bool operator==(const Part&) const = default;
  };

  std::vector<Part> parts_;
};

}  // namespace ombre::stores
