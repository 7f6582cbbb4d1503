// Where the edges of a layer's cells cross borders, and where the vertices between the crossings lie.
#pragma once

#include "base/system/progress.h"
#include "surface/outline/outline_cells.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// Fills in positions and normals of crossings in layer k of the lattice of corners. Throws Cancelled.
void find_outline_crossings(const Partition& partition, const voxel::Lattice& corners, int64_t k, OutlineGraph& graph,
                            const StopFlag* stop = nullptr);

// The mean of a vertex's crossings, which lies in its cell.
Vec2 mean_point(const OutlineGraph& graph, const OutlineVertex& vertex);
// Of the points around its cell, the one nearest to the borders through its crossings.
Vec2 point_on_cell(const voxel::Lattice& corners, const OutlineGraph& graph, const OutlineVertex& vertex);
bool is_in_cell(const voxel::Lattice& corners, const OutlineVertex& vertex);

// Puts vertices where the borders through their crossings meet; if that is cells away, on their own cells.
void place_outline_vertices(const voxel::Lattice& corners, OutlineGraph& graph);

}  // namespace ombre::surface
