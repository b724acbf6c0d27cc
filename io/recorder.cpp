#include "io/recorder.hpp"

#include <algorithm>
#include <utility>

#include "io/history_columns.hpp"
#include "io/tip_report.hpp"

namespace riven {

template <class Real>
Recorder<Real>::Recorder(const std::filesystem::path& folder, const SimulationOf<Real>& simulation,
                         const Probes& probes, const std::string& rows)
    : m_(simulation), probes_(probes), history_(folder / "history.csv", columns(), rows) {}

template <class Real>
void Recorder<Real>::row() {
  const auto& s = m_.state;
  const Energy& e = s.ledger.energy;
  const Momentum& p = s.ledger.momentum;
  std::vector<double> v{s.clock.time,  s.clock.dt, e.kinetic,  e.strain,   e.external_work, e.damping,        e.contact,
                        e.numerical(), p.error(),  p.linear.x, p.linear.y, p.angular,       p.angular_error()};
  for (const Watched which : watched(m_.plan))
    v.push_back(monitor(s.monitors, which).value);
  if (m_.plan.constraints)
    v.push_back(e.capture);
  if (m_.plan.transfer != Transfer::flip)
    v.push_back(e.transfer);
  if (m_.plan.anchors_strains())
    v.push_back(e.anchoring);
  if (m_.plan.tractions)
    v.insert(v.end(), {e.cohesive, e.debonding});
  for (const ConstraintOwner& o : s.constraints.owners)
    v.insert(v.end(), {o.travel.x, o.travel.y, o.mean.value.x, o.mean.value.y});
  if (m_.plan.growth)
    v.push_back(e.fracture);
  add_tip_values(m_.scene, s.tips, s.cracks, v);
  for (const std::vector<Tip>& reading : s.readings)
    add_reading_values(reading, v);
  for (const double q : probes_.read(m_))
    v.push_back(q);
  history_.row(v);
}

template <class Real>
std::vector<Summary::Value> Recorder<Real>::probes() const {
  std::vector<Summary::Value> list;
  const std::vector<HistoryColumn> columns = probes_.columns();
  const std::vector<double> values = probes_.read(m_);
  for (size_t i = 0; i < values.size(); ++i)
    list.push_back({columns[i].name, values[i], columns[i].unit});
  return list;
}

template <class Real>
std::vector<HistoryColumn> Recorder<Real>::columns() const {
  std::vector<HistoryColumn> c = quantity_columns(m_.plan);
  for (const ConstraintOwner& o : m_.state.constraints.owners)
    for (const auto& [what, unit] :
         {std::pair{"travel_x", "m"}, {"travel_y", "m"}, {"reaction_x", "N"}, {"reaction_y", "N"}})
      c.push_back({o.name + " " + what, unit});
  if (m_.plan.growth)
    c.push_back(growth_column());
  const auto add = [&](const std::vector<HistoryColumn>& more) { c.insert(c.end(), more.begin(), more.end()); };
  add(tip_columns(m_.state.tips, m_.state.cracks));
  for (const FractureReading& r : m_.scene.readings)
    add(reading_columns(r, m_.state.tips, m_.state.cracks));
  add(probes_.columns());
  return c;
}

#define RIVEN_RECORDER(Real) template class Recorder<Real>;
RIVEN_EACH_REAL(RIVEN_RECORDER)
#undef RIVEN_RECORDER

}  // namespace riven
