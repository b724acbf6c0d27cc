#include "kernels/grow_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/fracture/extend_crack.hpp"
#include "core/fracture/growth.hpp"
#include "core/fracture/stress_intensity.hpp"
#include "core/state/bodies_at_cracks.hpp"
#include "core/state/make_tips.hpp"
#include "core/state/tractions.hpp"
#include "kernels/bring_near.hpp"
#include "kernels/particles_near.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

constexpr double facing = 0.5;  ///< cosine of the angle up to which tips face each other, and are in each other's way
constexpr double beyond_edge = 2;  ///< cells by which a crack that leaves the solid is drawn on, if there is room
constexpr double around_tip = 6;   ///< cells beyond the contour, at most, where a tip looks for solid ahead of it
constexpr double rest = 20;        ///< segments' time without growth after which a tip has arrested
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
        rule_(growth_rule_at(m.scene, tip)) {
    const Body& body = scene_.bodies[static_cast<size_t>(tip.body)];
    particle_ = scene_.cell / body.particles_per_cell;
    thickness_ = s_.thickness[tip.body];
    const double wave = rayleigh_speed(scene_.materials[static_cast<size_t>(tip.material)], scene_.plane);
    limit_ = rule_.speed_limit > 0 ? rule_.speed_limit : wave;
    start_limit_ = std::max(limit_, wave);
    now_ = s_.clock.time + s_.clock.dt;
    x_ = s_.cracks.plane[s_.cracks.end_point(tip.crack, tip.last)];
    ahead_ = direction(tip);
  }

  void check() {
    take_mean();
    // how fast a tip may run says nothing of when it starts
    const long interval = check_interval(particle_, tip_.running ? limit_ : start_limit_, s_.clock.dt);
    const long alone = steps_alone();
    tip_.due = s_.clock.step + (tip_.running ? interval : std::max(interval, alone));
    const std::optional<Vec2> way = next_way();
    Tip* const other = way || tip_.running ? facing_tip() : nullptr;
    if (other)
      return meet(*other);
    if (!way)
      return wait();
    const double segment = tip_.running ? std::min(particle_, limit_ * (now_ - tip_.grew)) : particle_;
    if (const auto obstacle =
            first_obstacle(s_.cracks, tip_.crack, tip_.last, *way, segment + 0.5 * particle_, 0.5 * particle_, boxes_))
      return join(*obstacle);
    const Vec2 to = x_ + segment * *way;
    if (!solid_ahead(s_, to, *way, particle_))
      return leave(to, *way, segment);
    extend_crack(s_.cracks, tip_.crack, tip_.last, to, first(to));
    lay_at_end();
    book(segment);
    tip_.body = body_near(s_, to, 2 * particle_, tip_.body);
    tip_.material = scene_.bodies[static_cast<size_t>(tip_.body)].material;
    look_for_other_solids(to);
  }

 private:
  /// What drives a tip that runs, as the mean over its checks since it grew last.
  void take_mean() {
    if (!tip_.running || !tip_.sound) {
      tip_.checks = 0;
      return;
    }
    const double part = 1. / static_cast<double>(++tip_.checks);
    const auto blend = [&](double& mean, double& now) {
      mean += part * (now - mean);
      now = mean;
    };
    blend(tip_.mean_I, tip_.drive_I);
    blend(tip_.mean_II, tip_.drive_II);
    blend(tip_.mean_release, tip_.release);
  }

  Vec2 direction(const Tip& t) const {
    const Vec2 d =
        s_.cracks.plane[s_.cracks.end_point(t.crack, t.last)] - s_.cracks.plane[s_.cracks.next_to_end(t.crack, t.last)];
    return d * (1 / norm(d));
  }

  /// Where no contour is sound what is left of the solid ahead is a cell or two: a tip that runs goes through it, and
  /// so does one at rest that is driven, though the least contour takes in too little of the solid to say where to.
  std::optional<Vec2> next_way() const {
    if (tip_.sound)
      return growth_direction(rule_, tip_, ahead_);
    return tip_.running || load_now() >= 1 ? way_out() : std::nullopt;
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

  /// The way nearest to straight on that leads out of the solid or into another crack within the contour, or, at an
  /// angle, within the cells that the least contour takes: what is left of the solid there none can tell about.
  std::optional<Vec2> way_out() const {
    if (length_out(ahead_, (0.5 * scene_.fracture.contour + 1) * scene_.cell))
      return ahead_;
    constexpr int angles = 5;
    for (int k = 1; k <= angles; ++k) {
      const double angle = k * std::numbers::pi / (2 * angles);
      const Vec2 on = std::cos(angle) * ahead_, aside = std::sin(angle) * turned(ahead_);
      const Vec2 ways[2] = {on + aside, on - aside};
      const std::optional<double> length[2] = {length_out(ways[0], 2.25 * scene_.cell),
                                               length_out(ways[1], 2.25 * scene_.cell)};
      if (length[0] || length[1])
        return ways[!length[0] || (length[1] && *length[1] < *length[0])];
    }
    return std::nullopt;
  }

  /// How far away the edge of the solid, or another crack, is, m; none beyond reach.
  std::optional<double> length_out(Vec2 way, double reach) const {
    const auto obstacle = first_obstacle(s_.cracks, tip_.crack, tip_.last, way, reach, 0, boxes_);
    const auto outside = [&](double d) { return !solid_ahead(s_, x_ + d * way, way, particle_); };
    const double limit = obstacle ? obstacle->distance : reach;
    double d = 0;
    while (d < limit && !outside(d))
      d += particle_;
    if (!(d < limit))
      return obstacle ? std::optional(obstacle->distance) : std::nullopt;
    double within = std::max(0., d - particle_);
    for (int halving = 0; halving < 10; ++halving) {
      const double middle = 0.5 * (within + d);
      (outside(middle) ? d : within) = middle;
    }
    return d;
  }

  Tip* facing_tip() const {
    Tip* nearest = nullptr;
    double least = scene_.cell;
    for (Tip& t : s_.tips) {
      if (&t == &tip_ || !t.open)
        continue;
      const Vec2 r = s_.cracks.plane[s_.cracks.end_point(t.crack, t.last)] - x_;
      const double d = norm(r);
      if (!(d > 0 && d < least))
        continue;
      const Vec2 its = direction(t);
      if (std::min({dot(r, ahead_) / d, -dot(r, its) / d, -dot(ahead_, its)}) > facing) {
        least = d;
        nearest = &t;
      }
    }
    return nearest;
  }

  void meet(Tip& other) {
    const Cracks& c = s_.cracks;
    const int k = c.end_point(other.crack, other.last);
    Obstacle o;
    o.on = {tip_.crack, tip_.last, other.crack,
            std::max(0, k - c.start[static_cast<size_t>(other.crack)] - int{other.last}), double(other.last)};
    o.place = c.plane[k];
    o.distance = norm(o.place - x_);
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
    if (since * limit_ > rest * particle_) {
      tip_.running = false;
      tip_.speed = 0;
      record(tip_, CrackEvent::Kind::arrest, x_, -1);
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
    keep_to_region(scene_, tip_.crack, tip_.last, s_.cracks);
  }

  /// The tip has grown by a segment.
  void book(double segment) {
    if (tip_.running) {
      tip_.speed += 0.25 * (segment / (now_ - tip_.grew) - tip_.speed);
    } else {
      tip_.running = true;
      record(tip_, CrackEvent::Kind::start, x_, -1);
    }
    tip_.grew = now_;
    tip_.checks = 0;
    tip_.length += segment;
    const double released = std::max(0., tip_.release) * segment * thickness_;
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
  double particle_, thickness_;
  double limit_, start_limit_;  ///< m/s, of a tip that runs, and of what one at rest may have come to
  double now_;                  ///< at the end of this step
  Vec2 x_, ahead_;
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
