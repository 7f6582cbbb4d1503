// The program `ombre`.
#include <malloc.h>

#include "ombre/command_line.h"
#include "ombre/python_designs.h"

int main(int argc, char** argv) {
  // Slabs come and go by the megabyte: handing their pages back each time costs more than filling them.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  if (ombre::cli::needs_python(argc, argv)) return ombre::cli::become_python(argc, argv);
  return ombre::cli::run(argc, argv);
}
