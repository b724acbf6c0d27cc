// Instantiates for the device what a particle goes through in a step (its weights, the sums to the nodes and back,
// with and without crack fields, and its law) and what a node near a crack does (crossings, contact).
#include "every_header.hpp"

namespace {

using namespace riven;

/// One particle a thread.
template <class Real, class Shape, class Law>
__global__ void step(long particles, Positions<Real> positions, const Law* laws, const std::uint8_t* body, int nx,
                     Real* mass, Real* q, CrossingSlots extra, LawState<Real>* state) {
  const long p = blockIdx.x * static_cast<long>(blockDim.x) + threadIdx.x;
  if (p >= particles)
    return;
  const bool crosses = extra.crossing && extra.crossing[p] != 0;  // blocks of one particle
  const NodeTarget<Real> grid{mass, q, nx, 0, 0};
  Block<Real, Shape> w;
  w.weigh(positions, p);
  const Quad<Real> one{1, 1, 1, 1};
  Gathered<Real> g;
  if (!crosses) {
    scatter<true, true>(w, 0, Real(1), one, one, one, grid);
    g = gather<true>(w, 0, q, nx);
  } else {
    const int* slots = extra.slots + extra.block_slots[p];
    scatter_slots<true, true>(w, 0, Real(1), one, one, one, grid, slots, extra, mass, q);
    g = gather_slots<true>(w, 0, q, slots);
  }
  const Law law = laws[body[p]];
  law.update(exp_minus_identity(Mat2<Real>{g.dx[0], g.dy[0], g.dx[1], g.dy[1]}), state[p]);
  exec::atomic_add(mass[0], Real(law.energy(state[p]) + law.wave_speed(state[p]) + law.thickness_ratio(state[p].J) +
                                 law.stress_zz(state[p])));
}

/// One node near two cracks a thread: which cracks the path from a particle crosses, and contact of the four fields.
__global__ void touch(long nodes, const Vec2* particle, const Vec2* place, const Vec2* crack, int points,
                      const ContactSettings* settings, Vec2* momentum) {
  const long n = blockIdx.x * static_cast<long>(blockDim.x) + threadIdx.x;
  if (n >= nodes)
    return;
  CrossingSum crossings;
  for (int s = 0; s + 1 < points; ++s)
    crossings.add(crossing(particle[n], place[n], crack + s, s == 0, s + 2 == points));
  if (crossings.side() == Side::none)
    return;
  ContactNode node;
  for (int f = 0; f < ContactNode::fields; ++f) {
    node.mass[f] = 1;
    node.momentum[f] = momentum[ContactNode::fields * n + f];
  }
  const Vec2 normal = turned(crack[1] - crack[0]);
  node.add(touching_pair(settings[0], 0, 1, normal, 0, 1, false));
  node.add(touching_pair(settings[1], 2, 3, normal, 0, 1, false));
  const ContactOutcome out = solve(node);
  for (int f = 0; f < ContactNode::fields; ++f)
    momentum[ContactNode::fields * n + f] += out.impulse[f];
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

void every_body() {
  (void)&touch;
  every_shape<double>();
  every_shape<float>();
}
