// replay_corpus TARGET FOLDER: gives every file of a folder to a fuzz target, without a fuzzer.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#define FUZZ_TARGET(name) extern "C" int name(const uint8_t* data, size_t size);
#include "fuzz_targets.inc"
#undef FUZZ_TARGET

namespace {

struct Target {
  std::string_view name;
  int (*run)(const uint8_t*, size_t);
};

constexpr Target kTargets[] = {
#define FUZZ_TARGET(name) {#name, name},
#include "fuzz_targets.inc"
#undef FUZZ_TARGET
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int replay(const Target& target, const char* folder) {
  int count = 0;
  for (const std::filesystem::directory_entry& seed : std::filesystem::directory_iterator(folder)) {
    std::printf("%s\n", seed.path().filename().c_str());
    std::fflush(stdout);  // the last name printed is the one that failed
    const std::string bytes = contents(seed.path());
    target.run(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
    ++count;
  }
  return count > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "replay_corpus TARGET FOLDER\n"), 2;
  for (const Target& target : kTargets)
    if (target.name == argv[1]) return replay(target, argv[2]);
  std::fprintf(stderr, "no target %s\n", argv[1]);
  return 2;
}
