// Instantiates for the device what a particle goes through in a step: its weights, the sums to the nodes and back,
// with and without crack fields, and its law.
#include "every_header.hpp"

namespace {

using namespace riven;

/// One particle a thread.
template <class Real, class Shape, class Law>
__global__ void step(long particles, Positions<Real> positions, const Law* laws, const std::uint8_t* body, int nx,
                     Real* mass, Real* q, ExtraSlots<Real> extra, LawState<Real>* state) {
  const long p = blockIdx.x * static_cast<long>(blockDim.x) + threadIdx.x;
  if (p >= particles)
    return;
  const std::uint32_t word = extra.word ? extra.word[p] : 0;
  const NodeTarget<Real> grid{mass, q, nx, 0, 0};
  Block<Real, Shape> w;
  w.weigh(positions, p);
  const Quad<Real> one{1, 1, 1, 1};
  Gathered<Real> g;
  if (word == 0) {
    scatter<true, true>(w, 0, Real(1), one, one, one, grid);
    g = gather<true>(w, 0, q, nx);
  } else {
    scatter_fields<true>(w, 0, Real(1), one, one, one, grid, word, extra, mass, q);
    g = gather_fields<true>(w, 0, q, word, extra);
  }
  const Law law = laws[body[p]];
  law.update(exp_small(Mat2<Real>{g.dx[0], g.dy[0], g.dx[1], g.dy[1]}), state[p]);
  exec::atomic_add(mass[0], law.energy(state[p]) + law.wave_speed(state[p]) + law.thickness_ratio(state[p].J) +
                                law.stress_zz(state[p]));
}

template <class Real, class Shape>
void every_law() {
  (void)&step<Real, Shape, LinearElastic<Real>>;
  (void)&step<Real, Shape, NeoHookean<Real>>;
  (void)&step<Real, Shape, AnyElastic<Real>>;
}
template <class Real>
void every_shape() {
  every_law<Real, Linear>();
  every_law<Real, UGimp>();
  every_law<Real, BSpline>();
}

}  // namespace

void every_precision() {
  every_shape<double>();
  every_shape<float>();
}
