#include "io/scene_reader.hpp"

namespace riven {

namespace {

constexpr int most_retries = 1000;

void read_grid(const Table& root, Scene& s) {
  const Table t = root.table("grid", {"cell", "lower", "upper"});
  s.cell = t.quantity("cell", dimension::length, range::positive);
  s.grid = {t.vector("lower", dimension::length), t.vector("upper", dimension::length)};
}

void read_thresholds(const Table& limits, const char* name, Thresholds& thresholds) {
  const Table t = limits.table(name, {"energy", "momentum", "angular_momentum", "compression", "expansion", "stretch",
                                      "penetration", "velocity_difference"});
  for (const auto& [which, key] : Names<Watched>::table) {
    double& limit = thresholds[static_cast<size_t>(which)];
    if (which == Watched::velocity_difference) {
      if (t.has(key.data()))
        limit = t.quantity(key.data(), dimension::speed, range::positive);
    } else if (t.has(key.data()) || limit < no_limit) {
      limit = t.number(key.data(), range::positive, limit);
    }
  }
}

void read_limits(const Table& root, Precision precision, Limits& l) {
  const Table t = root.table("limits", {"energy_growth", "retries", "retry_cfl", "warn", "stop"});
  if (precision == Precision::as_float)
    l.warn[static_cast<size_t>(Watched::momentum)] = 1e-4;
  read_thresholds(t, "warn", l.warn);
  read_thresholds(t, "stop", l.stop);
  if (t.has("energy_growth"))
    l.energy_growth = t.number("energy_growth", range::positive);
  l.retries = t.integer("retries", 0, most_retries, l.retries);
  if (l.retries > 0 || t.has("retry_cfl"))
    l.retry_cfl = t.number("retry_cfl", Range{0, 1, true, true}, l.retry_cfl);
}

}  // namespace

void read_solver(const Table& root, Scene& s) {
  const Table t = root.table(
      "solver", {"time", "plane", "thickness", "shape", "transfer", "order", "pic_fraction", "affine", "stress_update",
                 "cfl", "dt_max", "scatter", "deterministic", "precision", "exec", "threads"});
  s.end_time = t.quantity("time", dimension::time, range::positive);
  s.plane = t.choice("plane", std::optional(s.plane));
  s.thickness = t.quantity("thickness", dimension::length, range::positive, s.thickness);
  s.shape = t.choice("shape", std::optional(s.shape));
  s.transfer = t.choice("transfer", std::optional(s.transfer));
  s.order = t.integer("order", 1, 100, s.order);
  s.pic_fraction = t.number("pic_fraction", Range{0, 1}, s.pic_fraction);
  s.affine = t.flag("affine", s.affine);
  s.stress_update = t.choice("stress_update", std::optional(s.stress_update));
  s.cfl = t.number("cfl", Range{0, 2, true}, s.cfl);
  s.dt_max = t.quantity("dt_max", dimension::time, range::positive, s.dt_max, "none");
  s.deterministic = t.flag("deterministic", s.deterministic);
  s.scatter = t.choice("scatter", std::optional(s.scatter));
  if (s.deterministic && s.scatter != ScatterKind::ordered)
    t.refuse("scatter", "a deterministic run needs ordered scatter", "ordered", "leave the key 'scatter' out");
  s.precision = t.choice("precision", std::optional(s.precision));
  s.exec = t.choice("exec", std::optional(s.exec));
  s.threads = t.integer("threads", 0, 4096, s.threads);
  read_grid(root, s);
  read_limits(root, s.precision, s.limits);
}

}  // namespace riven
