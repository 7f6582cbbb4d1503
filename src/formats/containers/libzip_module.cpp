// The module that links libzip.
#include "formats/containers/libzip_calls.h"

extern "C" const ombre::formats::LibzipCalls* ombre_libzip_calls() {
  static const ombre::formats::LibzipCalls calls;
  return &calls;
}
