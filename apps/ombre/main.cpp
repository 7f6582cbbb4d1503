// The program `ombre`.
#include "ombre/command_line.h"
#include "ombre/python_designs.h"
#include "sources/source_cache.h"

int main(int argc, char** argv) {
  if (ombre::cli::needs_python(argc, argv)) return ombre::cli::become_python(argc, argv);
  ombre::sources::SourceCache cache;
  ombre::cli::Host host;
  host.cache = &cache;
  return ombre::cli::run(argc, argv, host);
}
