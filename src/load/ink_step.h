// Resolves colours into shares of inks.
#pragma once

#include "load/node_maker.h"
#include "load/resolved_step.h"

namespace ombre::compile {

// True for the attributes that calibrations of inks read: "color_rgb" as a vector, "color_rgba" as a colour.
bool is_colour(const design::AttributeDeclaration& declared);

// Returns the calibration, one of inks as it reads the colours that the design gives: with alpha if they have some.
calibration::CalibrationPtr for_colours_of(const design::Design& design,
                                           const calibration::CalibrationPtr& calibration);

// Returns the profile of a calibration of inks. Throws Error if its file cannot be read.
ink::Profile profile_of(const calibration::InkUse& inks);

// Sets what the inks of the step's profile show. Returns false, and adds diagnostics, if the profile cannot be used.
bool load_inks(ResolvedStep& step, const NodeMaker& maker, Diagnostics& diagnostics);

// Returns the solid with the mixture of inks for its colours. Returns null, and adds diagnostics, if it cannot be made.
design::NodePtr with_inks(const design::NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker);

// Returns the profile's name and how it is used, for job.json.
Data describe(const calibration::InkUse& inks);

}  // namespace ombre::compile
