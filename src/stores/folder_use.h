// How a job uses a folder that may hold files already.
#pragma once

namespace ombre::stores {

enum class FolderUse {
  fresh,    // the folder must be empty or missing
  resume,   // continues the job there, if there is one
  replace,  // removes the files of the job there; files of others stay
};

}  // namespace ombre::stores
