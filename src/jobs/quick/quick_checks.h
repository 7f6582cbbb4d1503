// Cheap looks at a job before it is made, which warn and never refuse.
#pragma once

#include <map>
#include <string>

#include "jobs/common/events.h"
#include "jobs/quick/near_materials.h"
#include "questions/short_periods.h"
#include "voxel/printer.h"

namespace ombre::jobs {

void warn_of_short_periods(const Events& events, const compile::ShortPeriods& found, const voxel::Lattice& lattice);

// Looks for forbidden neighbours of the printer among the voxels of a job, whose materials have these numbers.
void warn_of_neighbours(const Events& events, const voxel::Printer& printer,
                        const std::map<std::string, MaterialId>& materials, const voxel::Lattice& lattice,
                        const compile::BoxOfVoxels& voxels, const StopFlag* stop);

}  // namespace ombre::jobs
