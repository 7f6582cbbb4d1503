// Selections of a study that only the design can answer.
#pragma once

#include "fea/model/study.h"
#include "load/loaded.h"

namespace ombre::compile {

// Nodes of a part are those of elements whose middle lies in it. A formula knows x, y and z and what else formulas
// know, and the design's attributes; a node is meant where it is not 0. What is handed over must live as long.
fea::ChooseNodes node_chooser(const Loaded& loaded, const fea::MeshView& mesh, int threads, const StopFlag* stop);

}  // namespace ombre::compile
