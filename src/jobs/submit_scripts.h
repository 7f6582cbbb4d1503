// Scripts that hand the shares of a plan to an engine which starts processes: Slurm, Kubernetes, GNU parallel, Dask.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::jobs {

struct Submission {
  std::string plan;    // the path of the plan, in the folder
  std::string folder;  // where the processes work
  int64_t shares = 1;
  bool has_stages = false;   // a process makes what all shares need before they begin
  int cores = 1;             // of each process
  int64_t minutes = 1;       // after which the engine may end a share
  int64_t memory_mib = 1;    // of each process
  int attempts = 1;          // how often a share is begun that fails by its machine
  std::string image, claim;  // of Kubernetes: what holds the program, and the volume with the folder
};

struct Engine {
  std::string name;
  std::string program;  // what the script calls first
  std::string ending;   // of the script, which takes the place of the plan's ".json"
  std::string starter;  // the program that runs the script
  bool has_own_folder;  // processes see the folder as a volume
  std::string (*script)(const Submission& submission);
};
const std::vector<Engine>& engines();

// Returns a text as one word of a shell.
std::string shell_word(std::string_view text);

}  // namespace ombre::jobs
