#include "io/summary.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/crack_opening.hpp"

namespace riven {
namespace {

using Json = nlohmann::ordered_json;  // in the order written here, as it is read by people too

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json point(Vec2 p) {
  return Json::array({number(p.x), number(p.y)});
}

/// A list with one object per item.
template <class T, class Make>
Json list(const std::vector<T>& items, Make&& make) {
  Json out = Json::array();
  for (const T& item : items)
    out.push_back(make(item));
  return out;
}

/// An object with one member per item.
template <class T, class Make>
Json by_name(const std::vector<T>& items, std::string T::*name, Make&& make) {
  Json out = Json::object();
  for (const T& item : items)
    out[item.*name] = make(item);
  return out;
}

/// Of keys, wherever they stand.
Json units() {
  return {
      {"time", "s"},        {"wall_seconds", "s"}, {"seconds", "s"},     {"energy", "J"},     {"relative_error", "1"},
      {"first_place", "m"}, {"place", "m"},        {"x", "m"},           {"y", "m"},          {"centre", "m"},
      {"length", "m"},      {"grown", "m"},        {"max_opening", "m"}, {"speed", "m/s"},    {"mass", "kg"},
      {"J", "J/m^2"},       {"J1", "J/m^2"},       {"J2", "J/m^2"},      {"reactions", "N"},  {"K_I", "Pa m^0.5"},
      {"K_II", "Pa m^0.5"}, {"O_I", "Pa m^0.5"},   {"O_II", "Pa m^0.5"}, {"M_I", "Pa m^0.5"}, {"M_II", "Pa m^0.5"}};
}

}  // namespace

std::vector<Summary::Crack> summarize_cracks(const Cracks& cracks, const std::vector<Tip>& tips) {
  const std::vector<CrackOpening> openings = crack_openings(cracks);
  std::vector<Summary::Crack> all;
  for (int c = 0; c < cracks.count(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    Summary::Crack out{cracks.names[k], 0, 0, 0};
    for (int i = cracks.start[c]; i < cracks.start[c + 1]; ++i) {
      out.max_opening = std::max(out.max_opening, openings[static_cast<std::size_t>(i)].normal);
      if (i > cracks.start[c])
        out.length += norm(cracks.plane[i] - cracks.plane[i - 1]);
    }
    all.push_back(out);
  }
  for (const Tip& t : tips)
    all[static_cast<std::size_t>(t.crack)].grown += t.length;
  return all;
}

void write_summary(const std::filesystem::path& path, const Summary& s) {
  Json j;
  j["scene"] = s.scene;
  j["title"] = s.title;
  j["status"] = s.status;
  if (!s.message.empty())
    j["message"] = s.message;
  j["steps"] = s.steps;
  j["time"] = number(s.time);
  j["wall_seconds"] = number(s.wall_seconds);
  j["particles"] = s.particles;
  j["particle_steps_per_second"] = number(s.particle_steps_per_second);
  j["peak_memory_bytes"] = s.peak_memory_bytes;
  j["threads"] = s.threads;
  j["exec"] = s.exec;
  j["scatter"] = s.scatter;
  j["precision"] = s.precision;
  j["units"] = units();
  j["effects"] = s.effects;
  j["tasks"] = list(s.tasks, [](const Summary::Task& t) {
    return Json{{"label", t.label}, {"effect", t.effect}, {"calls", t.calls}, {"seconds", number(t.seconds)}};
  });
  j["between_steps"] = list(s.between_steps, [](const Summary::Task& t) {
    return Json{{"label", t.label}, {"calls", t.calls}, {"seconds", number(t.seconds)}};
  });
  const Summary::Energy& e = s.energy;
  j["energy"] = {{"kinetic", number(e.kinetic)},   {"strain", number(e.strain)},
                 {"cohesive", number(e.cohesive)}, {"external_work", number(e.external_work)},
                 {"damping", number(e.damping)},   {"contact", number(e.contact)},
                 {"fracture", number(e.fracture)}, {"debonding", number(e.debonding)},
                 {"capture", number(e.capture)},   {"numerical", number(e.numerical)},
                 {"transfer", number(e.transfer)}, {"anchoring", number(e.anchoring)},
                 {"largest", number(e.largest)},   {"relative_error", number(e.relative_error)}};
  j["momentum_error"] = number(s.momentum_error);
  j["angular_momentum_error"] = number(s.angular_momentum_error);
  j["warnings"] = by_name(s.warnings, &Summary::Warning::kind, [](const Summary::Warning& w) {
    return Json{
        {"count", w.count}, {"first_place", w.count > 0 ? point(w.first_place) : Json(nullptr)}, {"try", w.advice}};
  });
  j["watched"] = by_name(s.watched, &Summary::Watched::figure, [](const Summary::Watched& w) {
    return Json{{"worst", number(w.worst)}, {"unit", w.unit}, {"place", point(w.place)}};
  });
  j["retries"] = list(s.retries, [](const Retry& r) {
    return Json{{"step", r.step},
                {"time", number(r.time)},
                {"back_to_step", r.back_to},
                {"cfl", number(r.cfl)},
                {"message", r.message}};
  });
  j["tips"] = list(s.tips, [](const Summary::Tip& t) {
    return Json{{"crack", t.crack},         {"end", t.end},           {"state", t.state},
                {"x", number(t.x)},         {"y", number(t.y)},       {"length", number(t.length)},
                {"J", number(t.J)},         {"J1", number(t.J1)},     {"J2", number(t.J2)},
                {"K_I", number(t.K_I)},     {"K_II", number(t.K_II)}, {"O_I", number(t.O_I)},
                {"O_II", number(t.O_II)},   {"M_I", number(t.M_I)},   {"M_II", number(t.M_II)},
                {"speed", number(t.speed)}, {"load", number(t.load)}, {"contour", t.contour},
                {"adapted", t.adapted}};
  });
  j["probes"] = by_name(s.probes, &Summary::Value::name, [](const Summary::Value& v) {
    return Json{{"value", number(v.value)}, {"unit", v.unit}};
  });
  j["cracks"] = list(s.cracks, [](const Summary::Crack& c) {
    return Json{{"name", c.name},
                {"max_opening", number(c.max_opening)},
                {"length", number(c.length)},
                {"grown", number(c.grown)}};
  });
  if (!s.fragments.empty())
    j["fragments"] = list(s.fragments, [](const Fragment& f) {
      return Json{{"mass", number(f.mass)}, {"particles", f.particles}, {"centre", point(f.centre)}};
    });
  j["reactions"] =
      by_name(s.reactions, &Summary::Reaction::grip, [](const Summary::Reaction& r) { return point(r.force); });
  // Names come from the user's scene: bytes that are no UTF-8 are replaced, not a reason to lose the results.
  write_file(path, j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace riven
