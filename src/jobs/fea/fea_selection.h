// Answers selections of a study that depend on the design.
#pragma once

#include "fea/model/study.h"
#include "load/loaded.h"

namespace ombre::compile {

// Returns a function that chooses nodes. Nodes of a part are those of elements whose middle lies in it. A formula, in
// the coordinates of all formulas and the design's attributes, chooses the nodes where it is not 0. The arguments must
// outlive the function.
fea::ChooseNodes node_chooser(const Loaded& loaded, const fea::MeshView& mesh, int threads, const StopFlag* stop);

}  // namespace ombre::compile
