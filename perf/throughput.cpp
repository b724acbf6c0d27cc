#include "perf/throughput.hpp"

#include <algorithm>
#include <memory>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/state/make_state.hpp"
#include "kernels/simulation.hpp"
#include "kernels/tally.hpp"

namespace riven::perf {

namespace {

/// An entrant in motion, and its times so far.
class Runner {
 public:
  Runner(const Entrant& entrant, int threads)
      : entrant_(entrant), space_(exec::Kind::openmp, threads), m_(entrant_.scene, space_), task_(m_.tasks.size()) {
    auto& p = m_.state.particles;
    for (long i = 0; i < p.count(); ++i) {
      const Vec2 v = entrant_.velocity({p.x[0][i], p.x[1][i]});
      p.v[0][i] = v.x;
      p.v[1][i] = v.y;
    }
    tally(space_, m_.plan, m_.state);  // before the first step: what momentum and energy start from
  }

  void run(int steps) {
    for (int s = 0; s < steps; ++s)
      m_.step();
  }
  void take_turn(int steps) {
    std::vector<double> before;
    for (const Task& t : m_.tasks)
      before.push_back(t.seconds);
    const long touched = m_.contact_after.touching;
    const double start = exec::Stopwatch::now();
    run(steps);
    seconds_.push_back((exec::Stopwatch::now() - start) / steps);
    for (size_t t = 0; t < before.size(); ++t)
      task_[t].push_back((m_.tasks[t].seconds - before[t]) / steps);
    contacts_ += m_.contact_after.touching - touched;
    steps_ += steps;
  }

  Result result() {
    tally(space_, m_.plan, m_.state);
    Result r;
    r.name = entrant_.name;
    r.without_cracks = entrant_.without_cracks;
    r.threads = space_.threads();
    r.particles = m_.state.particles.count();
    r.steps = steps_;
    r.seconds = seconds_;
    for (size_t t = 0; t < task_.size(); ++t)
      r.tasks.push_back(
          {m_.tasks[t].label, m_.tasks[t].effect, 1e9 * median(task_[t]) / static_cast<double>(r.particles)});
    for (const ArrayReport& a : list_arrays(m_.state))
      (a.name.rfind("particles", 0) == 0 ? r.particle_bytes : r.other_bytes) += a.bytes;
    r.contacts = contacts_;
    r.momentum_error = m_.state.ledger.momentum.error();
    r.energy_error = m_.state.ledger.energy.relative_error();
    return r;
  }

 private:
  Entrant entrant_;
  exec::Space space_;
  Simulation m_;
  std::vector<double> seconds_;
  std::vector<std::vector<double>> task_;  ///< [tasks][turns] seconds per step
  long contacts_ = 0, steps_ = 0;
};

}  // namespace

double Result::best_rate() const {
  return static_cast<double>(particles) / *std::min_element(seconds.begin(), seconds.end());
}
double Result::median_rate() const {
  return static_cast<double>(particles) / median(seconds);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1)
    return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::vector<Result> measure(const Group& group, const std::vector<int>& threads) {
  std::vector<std::unique_ptr<Runner>> runners;
  for (const Entrant& e : group.entrants())
    for (const int n : threads)
      runners.push_back(std::make_unique<Runner>(e, n));
  for (const auto& r : runners)
    r->run(group.warm_up);
  for (int turn = 0; turn < group.turns; ++turn)
    for (const auto& r : runners)
      r->take_turn(group.steps);
  std::vector<Result> results;
  for (const auto& r : runners)
    results.push_back(r->result());
  return results;
}

Overhead crack_overhead(const Result& result, const std::vector<Result>& all) {
  const auto plain = std::find_if(all.begin(), all.end(), [&](const Result& r) {
    return r.name == result.without_cracks && r.threads == result.threads;
  });
  if (plain == all.end())
    fail({Exit::internal, "no run without cracks to compare with", result.name});
  std::vector<double> ratios;
  for (size_t turn = 0; turn < result.seconds.size(); ++turn)
    ratios.push_back(result.seconds[turn] / plain->seconds[turn]);
  return {median(ratios) - 1, plain->best_rate() / result.best_rate() - 1};
}

}  // namespace riven::perf
