// Contact sheets of slice jobs.
#include "compile/job_sheet.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/json.h"
#include "compile/job_folder.h"
#include "export/contact_sheet.h"
#include "export/output_file.h"
#include "formats/file.h"

namespace ombre::compile {
namespace {

// The numbers of a member that must be a list of them.
std::vector<double> numbers(const Data* data, const std::string& path) {
  std::vector<double> values;
  if (data && data->list())
    for (const Data& element : *data->list())
      if (const double* number = element.number()) values.push_back(*number);
  if (!data || !data->list() || values.size() != data->list()->size()) throw Error(path + " is not a slice job");
  return values;
}

const Data* member(const Data* object, const char* name) { return object ? object->find(name) : nullptr; }

struct JobSummary {
  exporting::SheetStyle style;
  double origin_z_mm = 0, layer_mm = 0;
  size_t material_count = 0, check_count = 0;
};

JobSummary read_summary(const std::string& path) {
  Diagnostics ignored;
  const std::optional<Data> job = parse_json(make_source(path, formats::read_file(path)), ignored);
  const Data* sampling = member(job ? &*job : nullptr, "sampling");
  const std::vector<double> pitch = numbers(member(sampling, "pitch_mm"), path);
  const std::vector<double> origin = numbers(member(sampling, "origin_mm"), path);
  const Data* materials = member(&*job, "materials");
  const Data* checks = member(&*job, "checks");
  if (pitch.size() != 3 || origin.size() != 3 || !materials || !materials->list() || materials->list()->empty() ||
      !checks || !checks->list())
    throw Error(path + " is not a slice job");
  const std::vector<double> background = numbers(member(&materials->list()->front(), "rgba"), path);
  if (background.size() != 4) throw Error(path + " is not a slice job");

  JobSummary summary;
  summary.style.pixel_width_mm = pitch[0];
  summary.style.pixel_height_mm = pitch[1];
  for (size_t i = 0; i < 4; ++i)
    summary.style.background[i] = static_cast<uint8_t>(std::clamp(background[i], 0.0, 255.0));
  summary.origin_z_mm = origin[2];
  summary.layer_mm = pitch[2];
  summary.material_count = materials->list()->size() - 1;
  summary.check_count = checks->list()->size();
  return summary;
}

// Up to `most` elements, evenly spaced, each in the middle of its share.
template <class T>
std::vector<T> evenly_spaced(const std::vector<T>& all, size_t most) {
  const size_t count = std::min(all.size(), most);
  std::vector<T> chosen;
  for (size_t i = 0; i < count; ++i) chosen.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
  return chosen;
}

}  // namespace

void write_contact_sheet(const std::string& folder, const std::string& image_path, int layer_count) {
  const std::filesystem::path base(folder);
  const JobSummary summary = read_summary((base / job_file).string());
  const std::string journal = formats::read_file((base / journal_file).string());
  std::vector<exporting::SheetLayer> layers;
  for (const JournalEntry& entry : parse_journal(journal, summary.material_count, summary.check_count)) {
    if (entry.is_empty() || entry.file.empty()) continue;
    const double z_mm = summary.origin_z_mm + (static_cast<double>(entry.layer) + 0.5) * summary.layer_mm;
    layers.push_back({(base / entry.file).string(), entry.layer, z_mm});
  }
  if (layers.empty()) throw Error(folder + " has no layer with material to draw");
  layers = evenly_spaced(layers, static_cast<size_t>(std::max(1, layer_count)));
  const exporting::Picture sheet = exporting::draw_contact_sheet(layers, summary.style);
  exporting::write_file(image_path, formats::encode_png(sheet.width, sheet.height, sheet.rgba));
}

}  // namespace ombre::compile
