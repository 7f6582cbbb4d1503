// The program `ombre`.
#include <malloc.h>

#include "ombre/command_line.h"

int main(int argc, char** argv) {
  // Slabs come and go by the megabyte: handing their pages back each time costs more than filling them.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  return ombre::cli::run(argc, argv);
}
