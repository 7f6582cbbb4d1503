// The options of voxel grids.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/common/job_options.h"
#include "jobs/grid/grid_job.h"

namespace ombre::compile {

struct GridChoices {
  DesignOptions design;
  SamplingOptions sampling;
  std::string output, what;
  std::optional<Box> box;
  WorkOptions work;
  bool gzip = false, force = false;
  std::vector<std::string> settings;  // all options that were set: "--voxel=0.2"

  static const options::Spec<GridChoices>& options() {
    using namespace options;
    static const options::Spec<GridChoices> rows{
        group(&GridChoices::design, &GridChoices::sampling),
        option("-o,--output", &GridChoices::output, kind::file, "The file to write; its ending says the format", "FILE")
            .required(),
        option("--what", &GridChoices::what, kind::text,
               "Contents of voxels: materials (default; .vdb, .nvdb: distance,fractions), fractions, distance,\n"
               "attributes or names of attributes; several with commas",
               "WHAT"),
        option("--box", &GridChoices::box, kind::box, "Only the voxels that touch this box; mm", "X0,Y0,Z0,X1,Y1,Z1"),
        group(&GridChoices::work,
              WorkOptions::options("Most memory for slabs of voxels in flight and stages (default 2G)")),
        flag("--gzip", &GridChoices::gzip, "Compress the numbers of a .nrrd file"),
        flag("--force", &GridChoices::force, "Replace existing files, and write even if the disk seems too small")};
    static const options::Spec<GridChoices> spec = recorded(rows, &GridChoices::settings);
    return spec;
  }
  // Reads the options; `usual` stands for a missing --what. Sparse grids hold distances near the surface alone. Throws
  // options::WrongValue.
  GridQuery query(const std::string& usual, bool is_sparse) const;
};

}  // namespace ombre::compile
