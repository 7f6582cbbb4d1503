// Reports of `ombre diff`.
#pragma once

#include <string>

#include "jobs/common/events.h"
#include "jobs/stacks/diff_choices.h"
#include "jobs/stacks/material_changes.h"
#include "jobs/stacks/value_changes.h"

namespace ombre::jobs {

void tell_changes(const Events& events, const compile::MaterialChanges& changes, const voxel::Lattice& lattice);
void tell_changes(const Events& events, const compile::ValueChanges& changes, const voxel::Lattice& lattice);
// Returns a page with the changes, and pictures of the layers that change most.
std::string changes_page(const compile::DiffChoices& choices, const compile::MaterialChanges& changes,
                         const compile::ComparedSolid& a, const compile::ComparedSolid& b,
                         const voxel::Lattice& lattice);

std::string changes_page(const compile::DiffChoices& choices, const compile::ValueChanges& changes,
                         const compile::ComparedValues& a, const compile::ComparedValues& b,
                         const voxel::Lattice& lattice);

}  // namespace ombre::jobs
