// The module that links Embree, for distances to meshes.
#include "import/surfaces/embree_calls.h"

extern "C" const ombre::importing::EmbreeCalls* ombre_embree_calls() {
  static const ombre::importing::EmbreeCalls calls;
  return &calls;
}
