// Finds where the edges of a layer's cells cross borders, and places the vertices between the crossings.
#pragma once

#include "base/system/progress.h"
#include "surface/outline/outline_cells.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// Sets the positions and normals of the crossings in layer k of the lattice of corners. Throws Cancelled.
void find_outline_crossings(const Partition& partition, const voxel::Lattice& corners, int64_t k, OutlineGraph& graph,
                            const StopFlag* stop = nullptr);

// Returns the mean of a vertex's crossings, which lies in its cell.
Vec2 mean_point(const OutlineGraph& graph, const OutlineVertex& vertex);
// Returns the point on the boundary of the vertex's cell nearest to the borders through its crossings.
Vec2 point_on_cell(const voxel::Lattice& corners, const OutlineGraph& graph, const OutlineVertex& vertex);
bool is_in_cell(const voxel::Lattice& corners, const OutlineVertex& vertex);

// Places vertices where the borders through their crossings meet, or on the boundary of their own cell if that point is
// several cells away.
void place_outline_vertices(const voxel::Lattice& corners, OutlineGraph& graph);

}  // namespace ombre::surface
