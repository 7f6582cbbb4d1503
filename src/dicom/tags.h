// Tags of DICOM elements that several files read.
#pragma once

#include <gdcmTag.h>

namespace ombre::dicom {

inline const gdcm::Tag sop_class(0x0008, 0x0016), rows(0x0028, 0x0010), columns(0x0028, 0x0011);

}  // namespace ombre::dicom
