// Commands of the program that are not jobs.
#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "ombre/console.h"

namespace ombre::cli {

// The objects that a command works with after its arguments were read.
struct CommandSession {
  Console& console;
  const StopFlag& stop;
  sources::SourceCache& cache;  // cache of the files that designs name
};

struct Command {
  CLI::App* app = nullptr;
  std::function<int(CommandSession&)> run;  // runs the command and returns an exit code
};

// Options that all commands have for their output.
struct OutputOptions {
  bool quiet = false, json = false;
};
void add_output_options(CLI::App& app, OutputOptions& options);

Command add_commands(CLI::App& program, OutputOptions& output);
Command add_studio(CLI::App& program, OutputOptions& output);
Command add_completion(CLI::App& program);

}  // namespace ombre::cli
