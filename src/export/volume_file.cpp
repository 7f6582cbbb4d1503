#include "export/volume_file.h"

#include <algorithm>
#include <bit>
#include <filesystem>

#include "base/system/assert.h"
#include "base/text/json.h"
#include "formats/volumes/npy.h"
#include "formats/volumes/nrrd.h"

namespace ombre::exporting {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

DataList list(Vec3 v) { return {v.x, v.y, v.z}; }

std::string npy_header(const Volume& volume, bool) {
  const auto& [nx, ny, nz] = volume.count;
  return formats::npy_header(volume.is_float ? "<f4" : "|u1", {nz, ny, nx});
}

std::string nrrd_header(const Volume& volume, bool is_gzip) {
  formats::NrrdHeader header;
  header.type = volume.is_float ? "float" : "uint8";
  header.count = volume.count;
  header.spacing_mm = volume.spacing_mm;
  header.origin_mm = volume.origin_mm;
  header.is_gzip = is_gzip;
  for (const auto& [key, value] : volume.about)
    header.notes.emplace_back(key, value.string() ? *value.string() : print_json_line(value));
  return formats::nrrd_header(header);
}

std::string description(const std::string& path, size_t header_bytes, const Volume& volume) {
  DataMembers members{{"format", "ombre voxel grid, version 1"},
                      {"file", std::filesystem::path(path).filename().string()},
                      {"data_type", volume.is_float ? "float32" : "uint8"},
                      {"byte_order", "little"},
                      {"header_bytes", static_cast<double>(header_bytes)},
                      {"axes", DataList{"x", "y", "z"}},
                      {"fastest_axis", "x"}};
  const DataMembers of_volume = describe(volume);
  members.insert(members.end(), of_volume.begin(), of_volume.end());
  return print_json(members);
}

}  // namespace

DataMembers describe(const Volume& volume) {
  DataList count;
  for (const int64_t length : volume.count) count.emplace_back(static_cast<double>(length));
  DataMembers members{
      {"dimensions", count}, {"spacing_mm", list(volume.spacing_mm)}, {"origin_mm", list(volume.origin_mm)}};
  members.insert(members.end(), volume.about.begin(), volume.about.end());
  return members;
}

const std::vector<VolumeFormat>& volume_formats() {
  static const std::vector<VolumeFormat> rows{
      {".npy", "for NumPy, an array of shape (z, y, x); FILE.json describes it", npy_header, true},
      {".nrrd", "for 3D Slicer, ParaView and ITK; --gzip compresses", nrrd_header, false, true},
      {".raw", "numbers alone, x fastest; FILE.json describes them", nullptr, true},
  };
  return rows;
}

const VolumeFormat& volume_format(std::string_view ending) {
  const auto found = std::ranges::find(volume_formats(), ending, &VolumeFormat::ending);
  ASSERT(found != volume_formats().end());
  return *found;
}

std::string description_path(const std::string& path) { return path + ".json"; }

VolumeFile::VolumeFile(const std::string& path, const VolumeFormat& format, const Volume& volume, bool is_gzip)
    : file_(path) {
  const std::string header = format.header ? format.header(volume, is_gzip) : "";
  put(header);
  if (is_gzip) gzip_.emplace(volume.number_bytes(), volume.number_bytes() * static_cast<uint64_t>(volume.count[0]));
  if (!format.has_description) return;
  description_.emplace(description_path(path));
  description_->append(description(path, header.size(), volume));
  description_->close();
}

void VolumeFile::put(std::string_view bytes) {
  file_.append(bytes);
  bytes_ += bytes.size();
}

void VolumeFile::append(std::string_view numbers) {
  if (!gzip_) return put(numbers);
  gzip_->add(reinterpret_cast<const uint8_t*>(numbers.data()), numbers.size());
  put(gzip_->take());
}

void VolumeFile::close() {
  if (gzip_) {
    gzip_->finish();
    put(gzip_->take());
  }
  file_.close();
}

void VolumeFile::commit() {
  if (description_) description_->commit();
  file_.commit();
}

}  // namespace ombre::exporting
