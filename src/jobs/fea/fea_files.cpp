#include "jobs/fea/fea_files.h"

#include <filesystem>
#include <vector>

#include "base/text/file_ending.h"
#include "jobs/common/overwrite.h"
#include "jobs/fea/fea_rounds.h"

namespace ombre::jobs {
namespace {

// Returns the names of an output's files: one for each round, but a single one for their history.
std::vector<std::string> names_of(const compile::FeaChoices& a, const std::string& path) {
  if (a.rounds == 0 || ending_of(path) == ".csv") return {path};
  std::vector<std::string> names;
  for (int round = 1; round <= a.rounds; ++round) names.push_back(path_of_round(path, round));
  return names;
}

}  // namespace

std::string numbers_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".h5").string();
}

void refuse_to_overwrite(const compile::FeaChoices& a) {
  for (const std::string& path : a.outputs)
    for (const std::string& name : names_of(a, path)) {
      refuse_to_overwrite(name, a.force);
      if (ending_of(path) == ".xdmf") refuse_to_overwrite(numbers_path(name), a.force);
    }
}

}  // namespace ombre::jobs
