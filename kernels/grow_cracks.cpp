#include "kernels/grow_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/fracture/extend_crack.hpp"
#include "core/fracture/growth.hpp"
#include "core/fracture/stress_intensity.hpp"
#include "core/fracture/tip_motion.hpp"
#include "core/state/bodies_at_cracks.hpp"
#include "core/state/make_tips.hpp"
#include "core/state/tractions.hpp"
#include "kernels/around_tip.hpp"
#include "kernels/bring_near.hpp"
#include "kernels/particles_near.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

constexpr double beyond_edge = 2;  ///< cells by which a crack that leaves the solid is drawn on, if there is room
constexpr double around_tip = 6;   ///< cells beyond the contour, at most, where a tip looks for solid ahead of it
constexpr double slanted = 4;      ///< cells beyond the contour within which the rule's own way leads out of the solid
constexpr double still = 20;       ///< segments' time without growth after which a tip has arrested
constexpr double swings = 400;     ///< segments' time within which a tip at rest forgets what it has met
constexpr double unseen = 4;  ///< cells that a wave may go before a tip at rest is looked at again: its least contour

template <class Real>
class Growth {
 public:
  /// `boxes`: around the cracks as they are.
  Growth(SimulationOf<Real>& m, Tip& tip, const std::vector<Rectangle>& boxes)
      : scene_(m.scene),
        s_(m.state),
        report_(m.fracture),
        tip_(tip),
        boxes_(boxes),
        rule_(growth_rule_at(m.scene, tip)),
        particle_(scene_.cell / scene_.bodies[static_cast<size_t>(tip.body)].particles_per_cell),
        around_(s_, tip, particle_, boxes) {
    thickness_ = s_.thickness[tip.body];
    const double wave = rayleigh_speed(scene_.materials[static_cast<size_t>(tip.material)], scene_.plane);
    limit_ = rule_.speed_limit > 0 ? rule_.speed_limit : wave;
    start_limit_ = std::max(limit_, wave);
    memory_ = swings * particle_ / start_limit_;
    now_ = s_.clock.time + s_.clock.dt;
  }

  void check() {
    const double since = now_ - tip_.way.seen;
    take_mean();
    // how fast a tip may run says nothing of when it starts
    const long interval = check_interval(particle_, tip_.running ? limit_ : start_limit_, s_.clock.dt);
    const long alone = steps_alone();
    tip_.due = s_.clock.step + (tip_.running ? interval : std::max(interval, alone));
    const std::optional<Vec2> way = next_way(since);
    Tip* const other = way || tip_.running ? around_.facing_tip() : nullptr;
    if (other)
      return meet(*other);
    if (!way)
      return wait();
    const double segment = next_segment();
    if (const auto obstacle =
            first_obstacle(s_.cracks, tip_.crack, tip_.last, *way, segment + 0.5 * particle_, 0.5 * particle_, boxes_))
      return join(*obstacle);
    const Vec2 to = around_.place + segment * *way;
    if (!solid_ahead(s_, to, *way, particle_))
      return leave(to, *way, segment);
    extend_crack(s_.cracks, tip_.crack, tip_.last, to, first(to));
    lay_at_end();
    book(segment);
    tip_.body = body_near(s_, to, 2 * particle_, border_width * particle_, tip_.body,
                          [this](int body, int other) { return weaker(scene_, body, other); });
    tip_.material = scene_.bodies[static_cast<size_t>(tip_.body)].material;
    look_for_other_solids(to);
  }

 private:
  /// What drives a tip that runs or has run.
  void take_mean() {
    if (!tip_.running || !tip_.sound)
      tip_.checks = 0;
    if (!tip_.sound || (!tip_.running && tip_.length == 0))
      tip_.way.seen = now_;
    else if (tip_.running)
      drive_on();
    else
      drive_at_rest();
  }

  /// In the proportion of the modes since it grew last, which turns with its crack, as much as on the last cells of its
  /// way.
  void drive_on() {
    follow(tip_.way, tip_.release, now_);
    tip_.release = mean_release(tip_.way);
    const double part = 1. / static_cast<double>(++tip_.checks);
    tip_.mean_I += part * (tip_.drive_I - tip_.mean_I);
    tip_.mean_II += part * (tip_.drive_II - tip_.mean_II);
    const PlaneElasticity solid(scene_.materials[static_cast<size_t>(tip_.material)], scene_.plane);
    const double of_means = (tip_.mean_I * tip_.mean_I + tip_.mean_II * tip_.mean_II) / solid.E;
    const double scale = of_means > 0 ? std::sqrt(tip_.release / of_means) : 0;
    tip_.drive_I = scale * tip_.mean_I;
    tip_.drive_II = scale * tip_.mean_II;
  }

  /// In the proportion of the modes now.
  void drive_at_rest() {
    const double offered = offered_at_rest(tip_.way, tip_.release, memory_, now_);
    const double scale = tip_.release > 0 ? std::sqrt(offered / tip_.release) : 0;
    tip_.way.seen = now_;
    tip_.release = offered;
    tip_.drive_I *= scale;
    tip_.drive_II *= scale;
  }

  /// The way in which the crack grows now, if it does; `since`, s: the last check. Where no contour is sound what is
  /// left of the solid ahead is a cell or two: a tip that runs goes through it, and so does one at rest that is driven,
  /// though the least contour takes in too little of the solid to say where to.
  std::optional<Vec2> next_way(double since) {
    if (!tip_.sound)
      return tip_.running || load_now() >= 1 ? last_way() : std::nullopt;
    if (tip_.running ? has_gone_on(since) : load_now() >= 1) {
      const Vec2 ahead = around_.ahead, asked = growth_direction(rule_, tip_, ahead);
      const double angle = around_.told() * std::atan2(cross(ahead, asked), dot(ahead, asked));
      return std::cos(angle) * ahead + std::sin(angle) * turned(ahead);
    }
    return std::nullopt;
  }

  /// Out of what is left of the solid: in the direction that the rule asks for whatever the modes say, if it asks for
  /// one and that leads out.
  std::optional<Vec2> last_way() const {
    const int contour = scene_.fracture.contour;
    if (rule_.direction != GrowthDirection::hoop) {
      const Vec2 asked = growth_direction(rule_, tip_, around_.ahead);
      if (around_.leads_out(asked, 0.5 * contour + slanted))
        return asked;
    }
    return around_.way_out(contour);
  }

  /// m, by which the crack grows next.
  double next_segment() const { return tip_.running ? std::min(particle_, limit_ * (now_ - tip_.grew)) : particle_; }

  /// Moves a tip that runs on. Has it come nearer to the end of the next segment than it will be at the next check?
  bool has_gone_on(double since) {
    const double way = since * running_speed(tip_.way, load_now(), start_limit_, limit_);
    tip_.way.ahead += way;
    return tip_.way.ahead + 0.5 * way >= next_segment();
  }

  /// How near the tip is to growth. Where no contour is sound: the lesser of what J and K say, which agree where they
  /// mean something.
  double load_now() const {
    if (tip_.sound)
      return growth_load(rule_, tip_);
    Tip by_J = tip_;
    by_J.drive_I = tip_.K_I;
    by_J.drive_II = tip_.K_II;
    by_J.release = tip_.J;
    return std::min(growth_load(rule_, tip_), growth_load(rule_, by_J));
  }

  /// J/m^2, taken up by its growth. Where no contour is sound: as on its way until then, or its toughness.
  double release_now() const {
    if (tip_.sound)
      return tip_.release;
    if (tip_.running && tip_.way.time > 0)
      return mean_release(tip_.way);
    const double load = growth_load(rule_, tip_);
    return load > 0 ? tip_.release / (load * load) : 0;
  }

  void meet(Tip& other) {
    const Cracks& c = s_.cracks;
    const int k = c.end_point(other.crack, other.last);
    Obstacle o;
    o.on = {tip_.crack, tip_.last, other.crack,
            std::max(0, k - c.start[static_cast<size_t>(other.crack)] - int{other.last}), double(other.last)};
    o.place = c.plane[k];
    o.distance = norm(o.place - around_.place);
    join_crack(s_.cracks, o, c.plane0[k], scene_.cell);
    lay_at_end();
    book(o.distance);
    close(tip_, CrackEvent::Kind::meet, o.place, other.crack);
    close(other, CrackEvent::Kind::meet, o.place, tip_.crack);
  }

  /// Grows to a place with no solid ahead, and on: to the plane between the faces of an open crack, or away.
  void leave(Vec2 to, Vec2 way, double segment) {
    const double beyond = beyond_edge * scene_.cell;
    const auto open = first_obstacle(s_.cracks, tip_.crack, tip_.last, way, segment + beyond, 0, boxes_);
    if (open && solid_ahead(s_, open->place, way, scene_.cell))
      return join(*open, segment);
    extend_crack(s_.cracks, tip_.crack, tip_.last, to, first(to));
    book(segment);
    lay_at_end();
    const double on = way_before_solid(s_, to, way, beyond, particle_);
    extend_crack(s_.cracks, tip_.crack, tip_.last, to + on * way, first(to) + on * way);
    lay_at_end();
    end_bears_nothing(s_.cracks, tip_.crack, tip_.last);
    close(tip_, CrackEvent::Kind::exit, to, -1);
  }

  void join(const Obstacle& o) { join(o, o.distance); }
  void join(const Obstacle& o, double cut) {
    join_crack(s_.cracks, o, first(o.place), scene_.cell);
    lay_at_end();
    book(cut);
    close(tip_, CrackEvent::Kind::join, o.place, o.on.other);
    for (Tip& t : s_.tips)
      if (o.end && t.open && t.crack == o.on.other && t.last == o.end_last)
        close(t, CrackEvent::Kind::join, o.place, tip_.crack);
  }

  /// Steps for which the tip, if it rests, is left alone, by what its load has done since the last check.
  long steps_alone() {
    const double load = tip_.sound || !tip_.running ? load_now() : tip_.load;
    const long steps = s_.clock.step - tip_.checked;
    const double rise = steps > 0 ? (load - tip_.load) / static_cast<double>(steps) : load;
    tip_.load = load;
    tip_.checked = s_.clock.step;
    const PlaneElasticity solid(scene_.materials[static_cast<size_t>(tip_.material)], scene_.plane);
    return steps_at_rest(load, rise,
                         static_cast<long>(unseen * scene_.cell / (solid.dilatational_speed * s_.clock.dt)));
  }

  void wait() {
    const double since = now_ - tip_.grew;
    if (!tip_.running)
      return;
    tip_.speed = std::min(tip_.speed, particle_ / since);
    if (since * limit_ > still * particle_ && !(tip_.sound && tip_.load >= 1)) {
      tip_.running = false;
      tip_.speed = 0;
      const double load = load_now();
      stop(tip_.way, load > 0 ? tip_.release / (load * load) : 0, memory_, now_);
      record(tip_, CrackEvent::Kind::arrest, around_.place, -1);
    }
  }

  /// Counts a tip that has come so near to another material or thickness that its contour takes some of it in.
  void look_for_other_solids(Vec2 x) {
    if (scene_.bodies.size() < 2)
      return;
    const auto material = [&](int m) -> const Material& { return scene_.materials[static_cast<size_t>(m)]; };
    bool mixed = false;
    each_particle_near(s_, x, 0.5 * scene_.fracture.contour * scene_.cell, [&](int k) {
      const int body = s_.particles.body[k];
      mixed |= s_.thickness[body] != thickness_ ||
               !elastically_alike(material(scene_.bodies[static_cast<size_t>(body)].material), material(tip_.material));
    });
    if (mixed && report_.mixed++ == 0)
      report_.place[4] = x;
  }

  Vec2 first(Vec2 x) const {
    const int k = s_.cracks.end_point(tip_.crack, tip_.last);
    return first_position(s_, x, s_.cracks.plane0[k] - s_.cracks.plane[k]);
  }

  /// Gives the new point at the end what goes by its place.
  void lay_at_end() {
    lay_density_at_end(scene_, tip_.crack, tip_.last, s_.cracks);
    lay_traction_at_end(scene_, tip_.crack, tip_.last, s_.cracks);
  }

  /// The tip has grown by a segment.
  void book(double segment) {
    const double release = release_now();
    if (tip_.running) {
      tip_.speed += 0.25 * (segment / (now_ - tip_.grew) - tip_.speed);
      pass(tip_.way, segment, scene_.cell);
    } else {
      tip_.running = true;
      start(tip_.way, release, now_);
      tip_.due = s_.clock.step + check_interval(particle_, limit_, s_.clock.dt);
      record(tip_, CrackEvent::Kind::start, around_.place, -1);
    }
    tip_.grew = now_;
    tip_.checks = 0;
    tip_.length += segment;
    const double released = std::max(0., release) * segment * thickness_;
    tip_.released += released;
    s_.ledger.energy.fracture += released;
  }

  void close(Tip& t, CrackEvent::Kind kind, Vec2 place, int other) {
    record(t, kind, place, other);
    t.open = t.running = false;
    s_.cracks.set_open(t.crack, t.last, false);
    t.speed = 0;
    t.J = t.J1 = t.J2 = t.K_I = t.K_II = t.M_I = t.M_II = 0;  // there is no tip any more
  }

  void record(const Tip& t, CrackEvent::Kind kind, Vec2 place, int other) {
    s_.events.push_back({.kind = kind,
                         .step = s_.clock.step,
                         .time = now_,
                         .crack = t.crack,
                         .last = t.last,
                         .place = place,
                         .other = other,
                         .J = t.J,
                         .K_I = t.K_I,
                         .K_II = t.K_II,
                         .speed = t.speed,
                         .load = t.load});
  }

  const Scene& scene_;
  State<Real, 2>& s_;
  FractureReport& report_;
  Tip& tip_;
  const std::vector<Rectangle>& boxes_;
  const GrowthRule rule_;
  const double particle_;
  const AroundTip<Real> around_;
  double thickness_;
  double limit_, start_limit_;  ///< m/s, of a tip that runs, and of what one at rest may have come to
  double memory_;               ///< s, of a tip at rest
  double now_;                  ///< at the end of this step
};

}  // namespace

template <class Real>
void grow_cracks(SimulationOf<Real>& m) {
  auto& s = m.state;
  std::vector<Tip*> due;
  std::vector<Vec2> places;
  for (Tip& tip : s.tips)
    if (growth_due(tip, s.clock.step) && tip.step == s.clock.step) {
      due.push_back(&tip);
      places.push_back(s.cracks.plane[s.cracks.end_point(tip.crack, tip.last)]);
    }
  if (due.empty())
    return;
  exec::PartsOnHost parts;
  bring_near(m.space, s, places, 0.5 * m.scene.fracture.contour + around_tip, parts);
  std::vector<Rectangle> boxes;
  boxes.reserve(static_cast<size_t>(s.cracks.count()));
  for (int c = 0; c < s.cracks.count(); ++c)
    boxes.push_back(box_of(s.cracks, c));
  for (Tip* tip : due) {
    if (!growth_due(*tip, s.clock.step))  // another one has met it
      continue;
    Growth(m, *tip, boxes).check();
    boxes[static_cast<size_t>(tip->crack)] = box_of(s.cracks, tip->crack);
  }
}

#define RIVEN_GROW_CRACKS(Real) template void grow_cracks(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_GROW_CRACKS)
#undef RIVEN_GROW_CRACKS

}  // namespace riven
