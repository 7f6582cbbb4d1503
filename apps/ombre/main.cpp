// The program `ombre`.
#include "ombre/command_line.h"

int main(int argc, char** argv) { return ombre::cli::run(argc, argv); }
