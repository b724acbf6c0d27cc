// Particles: a structure of arrays, kept sorted by tile and cell. An array exists only if the plan asked for it.
//
// What grows step by step by a small part of itself is in double whatever Real is: a step moves a particle by 1e-5 of a
// cell or so, and strains it by as little, which in float would be lost on its place on a grid of a thousand cells and
// next to the unity in F. The cracks' crossing tests see exact places, too.
#pragma once
#include <cstdint>
#include <vector>

#include "core/exec/array.hpp"

namespace riven {

/// Sorted position of the particles of each tile, and the tiles grouped by colour: tiles of one colour never
/// write to the same node.
struct Tiles {
  exec::Array<int> start;       ///< [tiles + 1] first particle of each tile
  exec::Array<int> cell_start;  ///< [cells + 1] and of each cell, by Lattice::sorted_cell (contact, J)
  exec::Array<int> filled;      ///< tiles that hold particles, ascending
  exec::Array<int> by_colour;   ///< the same, colour after colour
  int colour_start[5] = {0, 0, 0, 0, 0};
  long order = 0;  ///< counts the sorts: while it stays, so does every particle's place
};

template <class Real, int Dim>
struct Particles {
  static constexpr int tensor = Dim * Dim;
  static constexpr int symmetric = Dim * (Dim + 1) / 2;

  exec::Array<double> x[Dim];           ///< position, m
  exec::Array<Real> v[Dim];             ///< velocity, m/s
  exec::Array<double> F[tensor];        ///< deformation gradient [F11 F12 F21 F22] (where a law or an output needs it)
  exec::Array<double> J;                ///< det F (laws that do not keep F)
  exec::Array<Real> stress[symmetric];  ///< Kirchhoff stress over reference density, [xx yy xy], m^2/s^2
  exec::Array<Real> mass;               ///< kg
  exec::Array<Real> C[tensor];          ///< gradient of velocity [C11 C12 C21 C22], 1/s (solver.affine)
  exec::Array<double> x0[Dim];          ///< first position, m (displacement-based contact, probes)
  exec::Array<double> closed[Dim];      ///< where it would be at first with gaps closed, m (first_gaps.hpp)
  exec::Array<std::uint8_t> body;       ///< index into Scene::bodies
  exec::Array<int> id;                  ///< stable number, 0 .. n-1
  Tiles tiles;

  int count() const { return static_cast<int>(id.size()); }

  /// f(array) for every array that holds one entry per particle and exists.
  template <class F_>
  void each_array(F_&& f) {
    auto some = [&](auto& a) {
      if (!a.empty())
        f(a);
    };
    for (auto& a : x)
      some(a);
    for (auto& a : v)
      some(a);
    for (auto& a : F)
      some(a);
    some(J);
    for (auto& a : stress)
      some(a);
    some(mass);
    for (auto& a : C)
      some(a);
    for (auto& a : x0)
      some(a);
    for (auto& a : closed)
      some(a);
    some(body);
    some(id);
  }
};

template <class Real>
double det_F(const Particles<Real, 2>& p, long i) {
  return p.J.empty() ? p.F[0][i] * p.F[3][i] - p.F[1][i] * p.F[2][i] : p.J[i];
}

}  // namespace riven
