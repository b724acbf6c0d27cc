#include "perf/runner.hpp"

#include <algorithm>

#include "core/state/make_state.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"
#include "kernels/tally.hpp"

namespace riven::perf {

namespace {

template <class Real>
class RunnerOf final : public Runner {
 public:
  RunnerOf(const Entrant& entrant, exec::Kind kind, int threads)
      : Runner(entrant), space_(kind, threads), m_(entrant_.scene, space_) {
    auto& p = m_.state.particles;
    for (long i = 0; i < p.count(); ++i) {
      const Vec2 v = entrant_.velocity({p.x[0][i], p.x[1][i]});
      p.v[0][i] = Real(v.x);
      p.v[1][i] = Real(v.y);
    }
    tally(space_, m_.plan, m_.state);  // before the first step: what momentum and energy start from
  }

  void run(int steps) override {
    for (int s = 0; s < steps; ++s)
      m_.step();
  }

  void measure_tasks(const Measure& measure) override {
    for (size_t i = 0; i < m_.tasks.size(); ++i) {
      auto& run = m_.tasks[i].run;
      run = [measure, i, work = run](SimulationOf<Real>& m) { measure(i, [&] { work(m); }); };
    }
  }

  bool slow_down(const std::string& label) override {
    const auto task = std::find_if(m_.tasks.begin(), m_.tasks.end(), [&](const auto& t) { return t.label == label; });
    if (task == m_.tasks.end())
      return false;
    task->run = [work = task->run](SimulationOf<Real>& m) {
      work(m);
      tally(m.space, m.plan, m.state);
    };
    return true;
  }

  long particles() const override { return m_.state.particles.count(); }
  int threads() const override { return space_.threads(); }
  long contacts() const override { return m_.contact_after.touching; }
  long crack_points() const override { return m_.state.cracks.points(); }

  std::vector<TaskRecord> tasks() const override {
    std::vector<TaskRecord> list;
    list.reserve(m_.tasks.size());
    for (const auto& t : m_.tasks)
      list.push_back({t.label, t.effect, t.seconds});
    return list;
  }

  std::vector<TaskRecord> kernels() const override {
    std::vector<TaskRecord> list;
    for (const exec::Timer& t : space_.timers().rows())
      list.push_back({t.label, "", t.seconds});
    return list;
  }

  Standing standing() override {
    tally(space_, m_.plan, m_.state);
    Standing s;
    for (const ArrayReport& a : list_arrays(m_.state))
      (a.name.rfind("particles", 0) == 0 ? s.particle_bytes : s.other_bytes) += a.bytes;
    s.momentum_error = m_.state.ledger.momentum.error();
    s.energy_error = m_.state.ledger.energy.relative_error();
    return s;
  }

 private:
  exec::Space space_;
  SimulationOf<Real> m_;
};

}  // namespace

std::unique_ptr<Runner> make_runner(const Entrant& entrant, exec::Kind kind, int threads) {
  return with_precision(entrant.scene.precision, [&](auto real) -> std::unique_ptr<Runner> {
    return std::make_unique<RunnerOf<typename decltype(real)::type>>(entrant, kind, threads);
  });
}

}  // namespace riven::perf
