// Everything that a simulation consists of, for runs that have to be the same to the last bit.
#pragma once
#include <cstring>
#include <map>
#include <string>

#include "kernels/each_member.hpp"
#include "kernels/simulation.hpp"
#include "tests/physics/scene_gates.hpp"

namespace riven::restarts {

using Bytes = std::map<std::string, std::string>;

/// Everything that a simulation consists of, as bytes. Times of tasks are of no interest.
class Collector {
 public:
  template <class Array>
  void fixed(const std::string& name, Array& a) {
    bytes[name] = std::string(reinterpret_cast<const char*>(a.data()),
                              static_cast<std::size_t>(a.size()) * (a.size() ? sizeof(*a.data()) : 0));
  }
  template <class Array>
  void growing(const std::string& name, Array& a) {
    fixed(name, a);
  }
  template <class Struct>
  void record(const std::string& name, Struct& one) {
    each_member(one, [&](const char* member, auto& value) {
      if (std::strcmp(member, "seconds") != 0)
        bytes[name].append(reinterpret_cast<const char*>(&value), sizeof value);
    });
  }
  template <class Struct>
  void records(const std::string& name, std::vector<Struct>& list) {
    bytes[name];
    for (Struct& one : list)
      record(name, one);
  }
  template <class Struct>
  void grown_records(const std::string& name, std::vector<Struct>& list) {
    records(name, list);
  }

  Bytes bytes;
};

template <class Real>
Bytes all_of(SimulationOf<Real>& m) {
  Collector c;
  each_member(m, c);
  return c.bytes;
}

/// Members that differ.
inline long differences(const Bytes& a, const Bytes& b) {
  long n = 0;
  for (const auto& [name, bytes] : a)
    n += !b.contains(name) || b.at(name) != bytes;
  return n + static_cast<long>(b.size()) - static_cast<long>(a.size());
}

/// Steps up to `end`, with a look at the energies now and then as runs have it; `each` after every step.
template <class Real, class Each>
void run(SimulationOf<Real>& m, long end, const Each& each) {
  while (m.state.clock.step < end) {
    m.step();
    if (m.state.clock.step % 7 == 0)
      m.take_stock();
    each();
  }
}

/// Ten cracks whose tips start at once, and run into each other.
inline Scene growing(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{"grid.cell=0.79375 mm",      "growth.toughness=0.05 MPa m^0.5",
                                    "solver.transfer=fmpm",      "solver.order=2",
                                    "output.history_every=5 us", "solver.stress_update=usavg"};
  settings.insert(settings.end(), more.begin(), more.end());
  return gates::shipped("ten_cracks_fast", settings);
}

}  // namespace riven::restarts
