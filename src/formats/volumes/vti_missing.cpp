// Builds without pugixml report that they cannot read VTK image data.
#ifndef OMBRE_3MF

#include "formats/containers/library_missing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {

VoxelVolume read_vti(const VolumeFile& file) {
  fail_volume(file.path, std::string("is VTK image data, and ") + xml_missing + "; " + xml_remedy);
}

}  // namespace ombre::formats

#endif
