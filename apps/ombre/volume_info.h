// Describes a volume for `ombre info`: as text, as data for programs, and as a picture of three planes.
#pragma once

#include <string>

#include "formats/volumes/volume.h"
#include "ombre/commands.h"

namespace ombre::cli {

struct VolumeArguments {
  formats::VolumeChoice choice;
  std::string picture;  // to write; empty: none
  bool force = false;   // replaces one that is there
};

// Prints what the file or folder holds; an exit code. Throws Error.
int show_volume(const std::string& path, const VolumeArguments& arguments, Session& session);

}  // namespace ombre::cli
