// The interface between decode() and the module with libjpeg-turbo.
#pragma once

#include "jpeg/jpeg_image.h"

// Decodes a picture; the function that the module exports.
extern "C" void ombre_read_jpeg(const std::string* name, const std::string_view* bytes, uint64_t most_pixels,
                                ombre::jpeg::Picture* picture);
