// The interface between read_document() and the module with libtiff.
#pragma once

#include "tiff/pages.h"

// Reads pages; the function that the module exports.
extern "C" void ombre_read_tiff(const std::string* name, const std::string_view* bytes, ombre::tiff::Wanted wanted,
                                const ombre::StopFlag* stop, ombre::tiff::Document* document);
