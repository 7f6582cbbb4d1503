// Evaluates layers slab by slab and writes them to a job folder as PNG files.
#pragma once

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Runs a job; progress counts voxels of the lattice. The same request gives the same bytes in the folder, however many
// threads, interruptions and parts it takes. Throws Error when a file or the folder fails, or when the folder holds
// something else, or another job to resume. Throws Cancelled when asked to stop, once the layers that are encoded are
// written. In both cases the folder can be resumed.
SliceReport slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options,
                  Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Estimates a job. Evaluates and encodes some layers, or rows of them if layers take long, for about two seconds, four
// at most, with as many threads as slicing, and extrapolates. Writes nothing: the time to write files is a guess for an
// idle disk. `regions` gives rows of layers over the whole width.
SliceEstimate estimate_slice(const SliceRequest& request, const RegionProducer& regions, const SliceOptions& options,
                             const StopFlag* stop = nullptr);

}  // namespace ombre::compile
