// Says how well inks show the colours that a design asks for.
#pragma once

#include <string>
#include <vector>

#include "base/text/data.h"
#include "jobs/resolve/colour_intent.h"

namespace ombre::jobs {

std::string percent(double share);

// Returns for example "color_rgb by our-inks".
std::string colour_heading(const compile::ColourIntent& colour);
// Returns sentences.
std::vector<std::string> colour_lines(const compile::ColourIntent& colour);
Data colour_data(const compile::ColourIntent& colour);

}  // namespace ombre::jobs
