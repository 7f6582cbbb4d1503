#include "base/system/environment.h"

#include <cstdlib>

namespace ombre {

std::string environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value ? value : "";
}

}  // namespace ombre
