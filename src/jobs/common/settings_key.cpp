#include "jobs/common/settings_key.h"

#include <map>
#include <set>

namespace ombre::jobs {

stores::JobKey settings_key(const std::string& name, const design::Design& design,
                            const std::vector<std::string>& settings, const std::string& program) {
  static const std::set<std::string> without{"design", "--output", "--threads", "--memory", "--force", "--resume"};
  stores::JobKey key;
  key.add(name, design::hash(design).hex());
  std::map<std::string, std::string> by_option;
  for (const std::string& setting : settings) {
    const std::string option = setting.substr(0, setting.find('='));
    if (!without.contains(option)) by_option[option] += setting + '\n';
  }
  for (const auto& [option, setting] : by_option) key.add(option, setting);
  key.add("the version of Ombre", program);
  return key;
}

}  // namespace ombre::jobs
