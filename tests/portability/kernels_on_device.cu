// Instantiates for the device what a node near a crack does (crossings, contact).
#include "every_header.hpp"

namespace {

using namespace riven;

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

}  // namespace

void every_body() {
  (void)&touch;
}
