#include "io/run_scene.hpp"

#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/scene/names.hpp"
#include "core/scene/schedule.hpp"
#include "io/atomic_file.hpp"
#include "io/event_log.hpp"
#include "io/frames.hpp"
#include "io/history.hpp"
#include "io/peak_memory.hpp"
#include "io/probes.hpp"
#include "io/progress.hpp"
#include "io/tip_report.hpp"

namespace riven {

namespace {

/// The quantities of every run, then the grips, the tips of cracks, and the scene's probes.
template <class Real>
class Recorder {
 public:
  Recorder(const std::filesystem::path& folder, const SimulationOf<Real>& m)
      : m_(m), probes_(m), history_(folder / "history.csv", columns(m, probes_)) {}

  void row() {
    const auto& s = m_.state;
    const Energy& e = s.ledger.energy;
    const Momentum& p = s.ledger.momentum;
    std::vector<double> v{s.clock.time, s.clock.dt, e.kinetic,        e.strain,  e.external_work,
                          e.damping,    e.contact,  e.numerical(),    p.error(), p.linear.x,
                          p.linear.y,   p.angular,  p.angular_error()};
    if (m_.plan.tractions)
      v.insert(v.end(), {e.cohesive, e.debonding});
    for (const ConstraintOwner& o : s.constraints.owners)
      v.insert(v.end(), {o.travel.x, o.travel.y, o.reaction.x, o.reaction.y});
    if (m_.plan.growth)
      v.push_back(e.fracture);
    add_tip_values(s.tips, v);
    for (const double q : probes_.read(m_))
      v.push_back(q);
    history_.row(v);
  }
  std::vector<Summary::Value> probes() const {
    std::vector<Summary::Value> list;
    const std::vector<HistoryColumn> columns = probes_.columns();
    const std::vector<double> values = probes_.read(m_);
    for (size_t i = 0; i < values.size(); ++i)
      list.push_back({columns[i].name, values[i], columns[i].unit});
    return list;
  }

 private:
  static std::vector<HistoryColumn> columns(const SimulationOf<Real>& m, const Probes& probes) {
    std::vector<HistoryColumn> c{{"time", "s"},
                                 {"dt", "s"},
                                 {"kinetic", "J"},
                                 {"strain", "J"},
                                 {"external_work", "J"},
                                 {"damping", "J"},
                                 {"contact", "J"},
                                 {"numerical", "J"},
                                 {"momentum_error", ""},
                                 {"momentum_x", "kg m/s"},
                                 {"momentum_y", "kg m/s"},
                                 {"angular_momentum", "kg m^2/s"},
                                 {"angular_momentum_error", ""}};
    if (m.plan.tractions)
      c.insert(c.end(), {{"cohesive", "J"}, {"debonding", "J"}});
    for (const ConstraintOwner& o : m.state.constraints.owners)
      for (const auto& [what, unit] :
           {std::pair{"travel_x", "m"}, {"travel_y", "m"}, {"reaction_x", "N"}, {"reaction_y", "N"}})
        c.push_back({o.name + " " + what, unit});
    if (m.plan.growth)
      c.push_back({"fracture", "J"});
    for (const auto& more : {tip_columns(m.state.tips, m.state.cracks), probes.columns()})
      c.insert(c.end(), more.begin(), more.end());
    return c;
  }

  const SimulationOf<Real>& m_;
  Probes probes_;
  History history_;
};

template <class Real>
std::vector<Summary::Warning> warnings(const SimulationOf<Real>& m) {
  std::vector<Summary::Warning> list;
  const CrackFields& f = m.state.fields;
  if (f.warning_both_sides > 0)
    list.push_back({"a node sees one crack from both sides", f.warning_both_sides, f.warning_place[0]});
  if (f.warning_third_crack > 0)
    list.push_back({"a node sees more than two cracks", f.warning_third_crack, f.warning_place[1]});
  const long capped = m.contact_before.capped + m.contact_after.capped + m.contact_again.capped;
  if (capped > 0)
    list.push_back({"contact at a node was not solved within the limit of sweeps", capped, {}});
  const FractureReport& j = m.fracture;
  const auto say = [&](const char* kind, long count, Vec2 place) {
    if (count > 0)
      list.push_back({kind, count, place});
  };
  say("two crack tips are too near to each other for a J contour between them", j.in_cell, j.place[0]);
  say("a J contour left the solid and was drawn in", j.drawn_in, j.place[1]);
  say("a J contour leaves the solid however small", j.unsound, j.place[2]);
  return list;
}

}  // namespace

template <class Real>
Summary summarize(const SimulationOf<Real>& m, double wall_seconds) {
  const auto& s = m.state;
  const Energy& e = s.ledger.energy;
  Summary out;
  out.scene = m.scene.name;
  out.title = m.scene.title;
  out.steps = s.clock.step;
  out.time = s.clock.time;
  out.wall_seconds = wall_seconds;
  out.particles = s.particles.count();
  out.particle_steps_per_second = static_cast<double>(out.particles) * static_cast<double>(out.steps) / wall_seconds;
  out.peak_memory_bytes = peak_memory();
  out.threads = m.space.threads();
  out.exec = exec::name(m.space.kind());
  out.scatter = name_of(m.plan.scatter);
  out.precision = name_of(m.scene.precision);
  out.effects = m.plan.effects();
  for (const TaskOf<Real>& t : m.tasks)
    out.tasks.push_back({t.label, t.effect, t.calls, t.seconds});
  out.energy = {e.kinetic, e.strain,   e.cohesive,  e.external_work, e.damping,
                e.contact, e.fracture, e.debonding, e.numerical(),   e.relative_error()};
  out.momentum_error = s.ledger.momentum.error();
  out.angular_momentum_error = s.ledger.momentum.angular_error();
  out.warnings = warnings(m);
  out.tips = summarize_tips(s.tips, s.cracks);
  out.cracks = summarize_cracks(s.cracks);
  for (const ConstraintOwner& o : s.constraints.owners)
    out.reactions.push_back({o.name, o.reaction});
  return out;
}

template <class Real>
Summary run_scene(SimulationOf<Real>& m, const RunOptions& options) {
  const Scene& scene = m.scene;
  const Clock& clock = m.state.clock;
  make_folder(options.folder);
  FrameWriter frames(options.folder, scene);
  Recorder record(options.folder, m);
  std::optional<EventLog> events;
  if (m.plan.growth)
    events.emplace(options.folder / "events.csv");
  Progress progress(0, scene.end_time, m.state.particles.count(), options.quiet);
  const double start = exec::Stopwatch::now();
  const double frame_every = scene.output.frames > 0 ? scene.end_time / scene.output.frames : scene.end_time;

  const auto close = [&](const char* status, const std::string& message) {
    frames.write(clock.time, m.state.particles, m.state.cracks);
    frames.finish();
    if (events)
      events->write(m.state.events, m.state.cracks);
    Summary s = summarize(m, exec::Stopwatch::now() - start);
    s.status = status;
    s.message = message;
    s.probes = record.probes();
    write_summary(options.folder / "summary.json", s);
    return s;
  };

  frames.write(0, m.state.particles, m.state.cracks);
  record.row();
  long written = 1;
  try {
    while (!m.finished()) {
      const double before = clock.time;
      m.step();
      if (events)
        events->write(m.state.events, m.state.cracks);
      progress.update(clock.step, clock.time, clock.dt, clock.limiter);
      const double reached = clock.time * (1 + 1e-12);
      if (report_due(scene, before, clock.time)) {
        m.take_stock();
        record.row();
      }
      if (reached >= static_cast<double>(written) * frame_every && !m.finished()) {
        frames.write(clock.time, m.state.particles, m.state.cracks);
        written = static_cast<long>(reached / frame_every) + 1;
      }
    }
  } catch (const Error& e) {
    progress.finish();
    if (e.code() == Exit::unstable)
      close("unstable", e.what());
    throw;
  }
  progress.finish();
  return close("done", "");
}

#define RIVEN_RUN(Real)                                          \
  template Summary summarize(const SimulationOf<Real>&, double); \
  template Summary run_scene(SimulationOf<Real>&, const RunOptions&);
RIVEN_RUN(double)
RIVEN_RUN(float)
#undef RIVEN_RUN

}  // namespace riven
