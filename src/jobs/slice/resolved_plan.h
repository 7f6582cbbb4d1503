// Resolves the properties of a design for a job.
#pragma once

#include <optional>

#include "jobs/common/plan_options.h"
#include "load/resolved.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// Returns the design with what the job needs: fractions of materials, or the attribute that its layers show. It is the
// design itself, without steps, if nothing is to be resolved. Returns nothing, and adds diagnostics, if it cannot be,
// or if calibrations were chosen that have nothing to do.
std::optional<Resolution> resolve_for_job(const LoadedPtr& loaded, const PlanOptions& options,
                                          Diagnostics& diagnostics);

// Adds an error for each attribute that a step reads, unless it is a colour, with values at voxels of the job that the
// step does not reach. `resolved` is the resolved design on the job's lattice; its stages must be prepared. Throws
// Cancelled.
void report_out_of_reach(const design::Design& resolved, const voxel::Lattice& lattice, const Resolution& resolution,
                         const PlanOptions& options, const SourceRange& where, Diagnostics& diagnostics);

}  // namespace ombre::compile
