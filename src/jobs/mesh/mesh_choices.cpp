#include "jobs/mesh/mesh_choices.h"

namespace ombre::compile {

MeshRequest MeshChoices::request() const {
  MeshRequest request{regions.request()};
  if (height_ranges) {
    request.bands.reset();
    request.crossed.clear();
  }
  request.beams = beams;
  request.join_flat = !keep_all;
  request.keeps_polyhedra = !keep_all && !regions.cell_mm && colour_by.empty();
  request.threads = work.threads;
  request.memory_bytes = work.memory_bytes;
  return request;
}

}  // namespace ombre::compile
