#include "base/system/free_memory.h"

#include <fstream>
#include <string>

namespace ombre {

uint64_t free_memory_bytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string name, unit; file >> name;) {
    uint64_t kibibytes = 0;
    file >> kibibytes;
    if (name == "MemAvailable:") return kibibytes << 10;
    std::getline(file, unit);
  }
  return 0;
}

}  // namespace ombre
