#include "perf/runner.hpp"

#include <algorithm>

#include "kernels/tally.hpp"

namespace riven::perf {

Runner::Runner(const Entrant& entrant, exec::Kind kind, int threads)
    : entrant_(entrant), space_(kind, threads), m_(entrant_.scene, space_) {
  auto& p = m_.state.particles;
  for (long i = 0; i < p.count(); ++i) {
    const Vec2 v = entrant_.velocity({p.x[0][i], p.x[1][i]});
    p.v[0][i] = v.x;
    p.v[1][i] = v.y;
  }
  tally(space_, m_.plan, m_.state);  // before the first step: what momentum and energy start from
}

void Runner::run(int steps) {
  for (int s = 0; s < steps; ++s)
    m_.step();
}

void Runner::measure_tasks(const Measure& measure) {
  for (size_t i = 0; i < m_.tasks.size(); ++i) {
    Task& task = m_.tasks[i];
    task.run = [measure, &task, i, work = task.run](Simulation& m) { measure(task, i, [&] { work(m); }); };
  }
}

bool Runner::slow_down(const std::string& label) {
  const auto task = std::find_if(m_.tasks.begin(), m_.tasks.end(), [&](const Task& t) { return t.label == label; });
  if (task == m_.tasks.end())
    return false;
  task->run = [work = task->run](Simulation& m) {
    work(m);
    tally(m.space, m.plan, m.state);
  };
  return true;
}

}  // namespace riven::perf
