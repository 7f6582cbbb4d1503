// The option for the slicer that a 3MF file is for.
#pragma once

#include "formats/slicers/flavour.h"
#include "options/option.h"

namespace ombre::compile {

template <class Job>
options::Row<Job> flavour_option(formats::SlicerFlavour Job::*member) {
  return options::choice("--flavour,--flavor", member, formats::flavour_words(),
                         "Program that a .3mf is for: generic (default), or a project of prusa, bambu, orca or "
                         "snapmaker:\none object, with a volume and a filament for each body",
                         "SLICER");
}

}  // namespace ombre::compile
