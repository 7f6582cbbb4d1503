// Slicing: evaluates layers slab by slab and writes them to a job folder as PNG files.
#pragma once

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Progress counts voxels of the lattice. The same request gives the same bytes in the folder, however
// many threads, interruptions and parts it takes. Throws Error when a file or the folder fails, when the
// folder holds something else, or another job to resume; Cancelled when asked to stop, once the layers that
// are encoded are written. In both cases the folder can be resumed.
SliceReport slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options,
                  Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Evaluates and encodes layers here and there, or rows of them where layers take long, for two seconds or so, four at
// most, and as many at once as slicing does, and extrapolates. Writes nothing: the time to write files is a guess for a
// disk that is not busy. `regions` gives rows of layers over the whole width.
SliceEstimate estimate_slice(const SliceRequest& request, const RegionProducer& regions, const SliceOptions& options,
                             const StopFlag* stop = nullptr);

}  // namespace ombre::compile
