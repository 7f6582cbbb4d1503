// Jobs that are kept between starts of the studio.
#pragma once

#include <filesystem>
#include <functional>

#include "studio/exports.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// The list lies in the studio's folder for the state; without such a folder nothing is kept.
void write_kept_jobs(const std::filesystem::path& state, const DataList& jobs);
// Returns an empty list if there is none, or none that can be read.
DataList read_kept_jobs(const std::filesystem::path& state);

// Returns the design from which a kept job was made.
DesignOrigin origin_of(const Data& job);

// Returns the request by which a kept job goes on. `design` loads its design again. Throws RequestError.
ExportRequest revived(const Data& job, const Workspace& workspace, const std::function<OpenDesignPtr()>& design);

}  // namespace ombre::studio
