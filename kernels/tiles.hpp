// Runs a kernel over the tiles of particles, and hides the race between tiles that write to the same nodes.
//
//   each_tile(space, label, run, watch, body)
//       body(stretch, first, last, seen) for stretches of every tile that holds particles; bodies only read the grid.
//       `seen` is of type Watch::Seen, and goes to `watch` when the tile is done.
//   scatter_tiles<Mass>(space, label, kind, run, grid_mass, grid_q, watch, body)
//       body(stretch, first, last, target, seen); bodies add to the nodes of `target` and to the extra slots. With Mass
//       false nothing is added to the masses.
//
// and in bodies
//
//   ask_ahead(stretch, first)                        with each block of particles
//   each_particle<Shape>(stretch, first, count, f)   f(k, slots) for the particles of a block: where all nodes of a
//       particle stand that sees one of them across a crack, else a null pointer by its type, so that the loop is
//       compiled without the way out to the others.
//   each_four(stretch, w, first, count, in_cells, f, four)   on the host four(k) for lanes k .. k + 3 of the block w
//       where they have the same nodes, none of them across a crack; f(k, slots) as above for all others, and for all
//       where particles are no longer in the cells that they were sorted by (in_cells, views.hpp).
//   each_gathered<Gradient>(stretch, w, first, count, in_cells, f)   the same with f(k, FourTogether{}) for four, which
//       only gradients gain by.
//
// The kinds of scatter are
//
//   ordered  tiles of one colour at a time: no two tiles of a colour share a node, and every node is summed in the same
//            order on any number of threads
//   atomic   all tiles at once, each into a buffer of its own, added to the grid where tiles overlap
//
// A tile of 8 x 8 cells writes to the nodes -2 .. 9 around its corner (tile_reads.hpp), and shares all but the nodes
// 2 .. 5 with its neighbours.
#pragma once
#if defined(RIVEN_ON_DEVICE)
#include "kernels/tiles_on_device.hpp"
#else
#include "kernels/tiles_on_host.hpp"
#endif
