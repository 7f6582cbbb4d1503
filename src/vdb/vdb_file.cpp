// Writes .vdb files without the random identifier that the library inserts.
#ifdef OMBRE_OPENVDB

#include <openvdb/io/Archive.h>

#include <fstream>
#include <stdexcept>

#include "base/system/hash.h"
#include "vdb/grid_files.h"

namespace ombre::vdb {
namespace {

// The identifier follows the magic number (8 bytes), the versions of the format (4) and the library (8), and the flag
// for offsets (1).
constexpr std::streamoff uuid_begin = 21;
constexpr size_t uuid_length = 36;

Hash hash_from(std::istream& file) {
  std::string piece(size_t{1} << 22, '\0');
  Hash sum;
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())), file.gcount() > 0) {
    const std::string_view read(piece.data(), static_cast<size_t>(file.gcount()));
    sum = hash_bytes(sum.hex() + hash_bytes(read).hex());
  }
  return sum;
}

// Returns an identifier of 8-4-4-4-12 hexadecimal digits.
std::string uuid_of(const Hash& hash) {
  std::string text = hash.hex();
  for (const size_t place : {8, 13, 18, 23}) text.insert(place, "-");
  return text;
}

// Replaces the library's random identifier, by which readers distinguish files, with a hash of the content.
void name_by_content(std::fstream& file) {
  file.seekg(uuid_begin + static_cast<std::streamoff>(uuid_length));
  const std::string uuid = uuid_of(hash_from(file));
  file.clear();
  file.seekp(uuid_begin);
  file.write(uuid.data(), static_cast<std::streamsize>(uuid.size()));
}

// Replaces the library's own file class, which does not notice a full disk.
class Writer : public openvdb::io::Archive {
 public:
  void write_all(std::ostream& file, const openvdb::GridPtrVec& grids) const { write(file, grids, true); }
};

}  // namespace

void write_vdb(const std::string& path, const openvdb::GridPtrVec& grids) {
  Writer writer;
  writer.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary | std::ios::trunc);
  writer.write_all(file, grids);
  file.flush();
  if (file) name_by_content(file);
  file.close();
  if (!file) throw std::runtime_error("the disk is full, or fails");
}

}  // namespace ombre::vdb

#endif
