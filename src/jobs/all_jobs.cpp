#include "jobs/all_jobs.h"

#include <algorithm>

namespace ombre::jobs {

// The functions below are defined in the rooms of their kinds.
JobKind slice_kind();
JobKind layer_kind();
JobKind render_kind();
JobKind voxels_kind();
JobKind mesh_kind();
JobKind contours_kind();
JobKind fea_kind();
JobKind homogenise_kind();
JobKind characterise_kind();
JobKind sheet_kind();
JobKind probe_kind();
JobKind info_kind();
JobKind nodes_kind();
JobKind printers_kind();
JobKind materials_kind();
JobKind scad_kind();
JobKind bundle_kind();
JobKind optimise_kind();
JobKind codes_kind();
JobKind operators_kind();
JobKind formats_kind();
JobKind plan_kind();
JobKind run_kind();
JobKind status_kind();
JobKind gather_kind();
JobKind submit_kind();
JobKind verify_kind();
JobKind diff_kind();
JobKind check_kind();
JobKind sweep_kind();
JobKind resolve_kind();
JobKind calibrations_kind();
JobKind tray_kind();

const std::vector<JobKind>& all_jobs() {
  static const std::vector<JobKind> all{
      slice_kind(),   layer_kind(),        render_kind(),       voxels_kind(), mesh_kind(),   contours_kind(),
      fea_kind(),     homogenise_kind(),   characterise_kind(), sheet_kind(),  probe_kind(),  info_kind(),
      nodes_kind(),   printers_kind(),     materials_kind(),    scad_kind(),   bundle_kind(), optimise_kind(),
      codes_kind(),   operators_kind(),    formats_kind(),      sweep_kind(),  plan_kind(),   run_kind(),
      status_kind(),  gather_kind(),       submit_kind(),       verify_kind(), diff_kind(),   check_kind(),
      resolve_kind(), calibrations_kind(), tray_kind()};
  return all;
}

const JobKind* find_job(std::string_view name) {
  const auto& all = all_jobs();
  const auto found = std::ranges::find(all, name, &JobKind::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace ombre::jobs
