// Commands of the program that are no jobs.
#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "ombre/console.h"

namespace ombre::cli {

// What a command gets once its arguments are read.
struct CommandSession {
  Console& console;
  const StopFlag& stop;
  sources::SourceCache& cache;  // of the files that designs name
};

struct Command {
  CLI::App* app = nullptr;
  std::function<int(CommandSession&)> run;  // returns an exit code
};

// How much a command says; options that all commands have.
struct OutputOptions {
  bool quiet = false, json = false;
};
void add_output_options(CLI::App& app, OutputOptions& options);

Command add_commands(CLI::App& program, OutputOptions& output);
Command add_studio(CLI::App& program, OutputOptions& output);
Command add_completion(CLI::App& program);

}  // namespace ombre::cli
