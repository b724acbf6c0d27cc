#include "core/plan/predict_memory.hpp"

#include "core/scene/area.hpp"
#include "core/state/grid.hpp"

namespace riven {

namespace {

double particles_of(const Body& body, double cell) {
  return area_of(body) * body.particles_per_cell * body.particles_per_cell / (cell * cell);
}

double bytes_of_particle(const Plan& p, double real) {
  constexpr double position = 2 * sizeof(double), body_and_id = 1 + sizeof(int);
  double bytes = position + body_and_id + real * (2 + 3 + 1);  // velocity, stress, mass
  bytes += sizeof(double) * (p.keeps_F() ? 4 : 1);
  if (p.affine)
    bytes += 4 * real;
  if (p.first_positions())
    bytes += position;
  if (p.first_gaps)
    bytes += position;
  if (p.cracks)
    bytes += sizeof(std::uint32_t);
  return bytes;
}

double bytes_of_node(const Plan& p, double real) {
  double vectors = 1;
  if (p.extrapolate_again())
    vectors += 1;
  if (p.higher_order() && p.order > 1)
    vectors += 3;
  double bytes = real * (1 + 4 * vectors + (p.full_mass() ? full_mass_entries : 0));
  if (p.constraints)
    bytes += sizeof(int);
  if (p.contact || p.anchors())
    bytes += sizeof(int);
  if (p.contact_position)
    bytes += sizeof(double);
  if (p.cracks)
    bytes += 4 * sizeof(int);
  return bytes;
}

}  // namespace

MemoryNeed predict_memory(const Scene& scene, const Plan& plan) {
  const double real = scene.precision == Precision::as_float ? sizeof(float) : sizeof(double);
  MemoryNeed need;
  for (const Body& body : scene.bodies)
    need.particles += particles_of(body, scene.cell);
  need.nodes = make_lattice(scene.grid.lower, scene.grid.upper, scene.cell).nodes();
  constexpr double working = 120;  // bytes per particle: 109 to 137 for 4 million, in double and in float
  need.working = working * need.particles;
  need.bytes = need.particles * bytes_of_particle(plan, real) + need.nodes * bytes_of_node(plan, real);
  return need;
}

}  // namespace riven
