#include "jobs/mesh/mesh_choices.h"

#include "base/text/text.h"
#include "formats/packages/mesh_formats.h"

namespace ombre::compile {
namespace {

// Refuses settings of slicers for files that cannot hold them.
void check_settings(const MeshChoices& a) {
  const formats::MeshFormat* const format = formats::find_mesh_format(a.output);
  if (!format || format->holds_settings) return;
  const auto refuse = [&](const Phrase& option) {
    throw options::WrongValue(option + ": " + a.output + " holds no settings of slicers; write " +
                              words_text(formats::mesh_endings_with(&formats::MeshFormat::holds_settings)));
  };
  if (!a.settings.empty()) refuse(spelled::option("--setting", a.settings.front()));
  if (formats::is_project(a.flavour)) refuse(spelled::option("--flavour", formats::flavour_word(a.flavour)));
}

}  // namespace

MeshRequest MeshChoices::request() const {
  check_settings(*this);
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
