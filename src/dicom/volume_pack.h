// Serializes series, for the transfer from a helper process.
#pragma once

#include "dicom/series.h"

namespace ombre::dicom {

std::string pack(const Series& series);
Series unpack(std::string_view bytes);
std::string pack_segments(const std::vector<Segment>& segments);
std::vector<Segment> unpack_segments(std::string_view bytes);

}  // namespace ombre::dicom
