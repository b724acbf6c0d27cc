// What the user wrote, in SI units, checked for meaning but not yet planned. Plain data: io/ fills it,
// core/plan turns it into tasks and arrays. No member depends on how it was written down.
#pragma once
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/exec/space.hpp"
#include "core/math/vec.hpp"
#include "core/scene/field.hpp"

namespace riven {

enum class ShapeFunction { linear, ugimp, bspline };
enum class Transfer { flip, pic, xpic, fmpm };  ///< pic: FLIP blended with a fraction of PIC
enum class StressUpdate { usl, musl, usf, usavg };
enum class Plane { strain, stress };
enum class ScatterKind { atomic, ordered };
enum class Precision { as_double, as_float };  ///< of what particles and nodes hold; see Particles
enum class LawKind { linear_elastic, neo_hookean };
enum class CrackMotion { surfaces, center_of_mass };  ///< how the crack plane moves
enum class SurfaceUpdate { xpic, flip, pic };         ///< how the crack surfaces move
enum class ContactLaw { ignored, bonded, stick, frictionless, coulomb, interface };
enum class ContactDetection { volume, velocity, displacement };  ///< displacement: velocity and displacement
enum class ContactWhen { always, closing };                      ///< closing: only while some faces touch
enum class Sidecar { none, vtp };
enum class JMethod { pijc, fijc, fijc_adaptive };  ///< what J does where other cracks cross the contour
enum class AreaTerm { automatic, never, always };  ///< automatic: for tips that run, or beyond 10 cells
enum class TractionKind { pressure, triangular, trilinear, exponential };
enum class GrowthCriterion { k_max, critical_j };
enum class GrowthDirection { hoop, self_similar, fixed };

// ---- shapes of bodies and regions ---------------------------------------------------------------------------

struct Rectangle {
  Vec2 lower, upper;
};
struct Disk {
  Vec2 center;
  double radius = 0;
};
struct Polygon {
  std::vector<Vec2> points;  ///< closed by the line from last to first
};
using Region = std::variant<Rectangle, Disk, Polygon>;

/// True when the point lies in the region (borders of rectangles and disks included).
bool contains(const Region& region, Vec2 point);
/// The smallest rectangle around the region.
Rectangle bounds(const Region& region);

// ---- parts of a scene ---------------------------------------------------------------------------------------

struct Material {
  std::string name;
  LawKind law = LawKind::linear_elastic;
  double E = 0;        ///< Young's modulus, Pa
  double nu = 0;       ///< Poisson's ratio
  double density = 0;  ///< kg/m^3
  double K_Ic = 0;     ///< Pa m^0.5, and
  double J_Ic = 0;     ///< J/m^2: toughness of tips in it whose growth rule has none; 0: not said
};

/// Whether waves and the fields around cracks see no difference between two materials.
inline bool elastically_alike(const Material& a, const Material& b) {
  return a.law == b.law && a.E == b.E && a.nu == b.nu && a.density == b.density;
}

struct Body {
  std::string name;
  int material = 0;  ///< index into Scene::materials
  Region region;
  std::vector<Region> holes;
  int particles_per_cell = 2;              ///< along each axis
  double thickness = 0;                    ///< m; 0 means the scene's
  Vec2 velocity;                           ///< initial, m/s
  std::optional<Field> velocity_field[2];  ///< initial, varying over the body, added to it, m/s
  double spin = 0;                         ///< initial angular velocity about the body's centre of mass, rad/s
};

/// A velocity component prescribed on grid nodes inside a box (a line is a box without width).
struct FixedNodes {
  std::string name;
  Rectangle box;
  std::optional<TimeFunction> velocity[2];  ///< m/s; an empty component is free
};

/// A symmetry plane: no normal velocity on the grid line and behind it.
struct SymmetryPlane {
  int axis = 0;         ///< 0: the plane x = position, 1: the plane y = position
  double position = 0;  ///< m; on a grid line
  int solid = +1;       ///< the side on which the body lies: +1 above, -1 below
};

/// A block of rigid particles that moves with a prescribed velocity and imposes it on every field of
/// every node that it touches.
struct Grip {
  std::string name;
  Region region;
  int particles_per_cell = 2;
  std::optional<TimeFunction> velocity[2];  ///< m/s; an empty component is free
};

/// A force shared evenly by the particles inside the region, a traction on the particles along one edge of a body, or
/// an acceleration of all particles inside the region.
struct Load {
  enum class Kind { force, traction, acceleration };
  enum class Edge { left, right, bottom, top };
  std::string name;
  Kind kind = Kind::force;
  Region region;            ///< which particles (force; and traction, as the part of the edge that is loaded)
  Edge edge = Edge::right;  ///< traction only: particles that have no neighbour on this side
  Field value[2];           ///< N in all (force), Pa (traction), or m/s^2 (acceleration)
};

struct ContactSettings {
  ContactLaw law = ContactLaw::frictionless;
  double friction = 0;          ///< Coulomb
  double normal_stiffness = 0;  ///< interface, Pa/m
  double shear_stiffness = 0;   ///< interface, Pa/m
};

struct ContactRules {
  ContactWhen when = ContactWhen::always;
  ContactDetection detection = ContactDetection::displacement;
  double v_sep = 0.9;      ///< volume detection: below this relative volume the faces are apart
  double v_contact = 1.1;  ///< above it they touch
};

/// What a crack's faces bear: a pressure, or a cohesive law that softens (core/laws/traction.hpp).
struct TractionSettings {
  TractionKind kind = TractionKind::pressure;
  std::optional<Region> region;  ///< the part of the crack that bears it; all of it where nothing is said
  TimeFunction pressure;         ///< Pa, pushes the faces apart
  // cohesive laws; values of shear are those of opening unless said
  double strength = 0, toughness = 0;              ///< Pa and J/m^2, of opening
  double shear_strength = 0, shear_toughness = 0;  ///< Pa and J/m^2, of sliding
  double peak = 0.05;                       ///< opening at the strength over the opening at which nothing is left
  double knee = 0.3, knee_strength = 0.25;  ///< trilinear: where the second descent begins, over that opening, and at
                                            ///< what part of the strength
  double decay = 4;                         ///< exponential: the traction falls as exp(-decay x), x from 0 to 1
};

/// How J and K are found at the tips of cracks (Nairn and Aimene, section 2.2.2). By fijc_adaptive J of a tip at rest,
/// where its crack bends or faces of another one are pressed together, is that of K by the interaction integral.
struct FractureRules {
  bool asked = false;  ///< J and K at every tip; growth asks for them, too
  JMethod method = JMethod::fijc_adaptive;
  int contour = 4;  ///< edge of the square contour, cells; even
  AreaTerm area = AreaTerm::automatic;
  bool interaction = true;  ///< K by the interaction integral, too, whenever J is reported
};

/// J and K of the same tips by other rules, from the same steps: for the history alone, growth does not see them.
struct FractureReading {
  std::string name;
  FractureRules rules;
};

/// When and where a crack grows.
struct GrowthRule {
  GrowthCriterion criterion = GrowthCriterion::k_max;
  /// K_Ic, Pa m^0.5 (k_max), or J_Ic, J/m^2 (critical_j); 0: that of the material around the tip
  double toughness = 0;
  GrowthDirection direction = GrowthDirection::hoop;
  Vec2 heading;            ///< direction = fixed
  double speed_limit = 0;  ///< m/s; 0 means the Rayleigh speed
};

struct CrackLine {
  std::string name;
  std::vector<Vec2> points;
  double resolution = 0;                     ///< greatest segment length, m; 0 means the particle size
  std::optional<ContactSettings> contact;    ///< its own law instead of the scene's
  std::optional<TractionSettings> traction;  ///< none: the faces are free where they do not touch
  std::optional<GrowthRule> growth;          ///< its own rule instead of the scene's
  bool grows = true;                         ///< false: stays as it is where the scene's cracks grow
};

/// A named result read from the fields at the end and at each history row.
struct Probe {
  enum class Kind { crack_opening, displacement, velocity, stress, reaction, travel, mean_stress, displacement_error };
  std::string name;
  Kind kind = Kind::crack_opening;
  Vec2 point;          ///< nearest particle (at the start) for displacement, velocity, stress
  int axis = 1;        ///< component
  int axis2 = 1;       ///< stress: second index
  std::string target;  ///< crack or grip name
  double over = 1;     ///< the result is divided by this: an area, m^2 (reaction), or a length, m (travel, error)
  Field exact[2];      ///< displacement_error: what the displacement should be, m
};

struct Output {
  int frames = 20;           ///< frames after the first, evenly over the run
  double history_every = 0;  ///< s; 0 means 1/250 of the run
  Sidecar sidecar = Sidecar::none;
  Precision precision = Precision::as_float;  ///< of the particles' fields, though not of their positions
  std::vector<std::string> fields;            ///< optional extra particle fields: "fringe"
  double fringe_constant = 0;                 ///< 1/Pa (Nairn 2003, eq. 23)
  double checkpoint_every = 600;  ///< s of wall time between checkpoints; 0: none but when the run is interrupted
  int checkpoint_steps = 0;       ///< steps between checkpoints, too; 0: not by steps
};

/// Figures by which a run is judged while it goes on, whenever stock is taken.
enum class Watched {
  energy,               ///< made or lost by nothing that accounts for it, over the largest energy so far
  momentum,             ///< error of the momentum over the largest so far
  angular_momentum,     ///< the same of the angular momentum, over the largest sum of m |x| |v| so far
  compression,          ///< 1 / least det F
  expansion,            ///< largest det F
  stretch,              ///< largest principal stretch
  penetration,          ///< overlap of faces, cells
  velocity_difference,  ///< of a particle and the grid where it is, m/s
};
inline constexpr int watched_figures = 8;

/// A limit for each; infinite where there is none.
using Thresholds = std::array<double, watched_figures>;
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Where a run is suspect, where it has gone wrong, and what it does then.
struct Limits {
  Thresholds warn{0.02, 1e-9, 0.05, 5, 5, 1.3, 0.25, no_limit};
  Thresholds stop{no_limit, no_limit, no_limit, no_limit, no_limit, no_limit, no_limit, no_limit};

  /// Largest (kinetic + strain + sinks - external work) over the largest energy so far; else as the plan says.
  std::optional<double> energy_growth;
  int retries = 0;         ///< how often the run goes back to its last checkpoint when it went wrong
  double retry_cfl = 0.5;  ///< by which the time step is multiplied each time
};

struct Scene {
  std::string name;  ///< file name without its ending
  std::string title;
  std::string source_path;
  std::string source_text;                   ///< the scene as read, with --set applied
  std::map<std::string, double> constants;   ///< that all shapes know, in SI
  std::map<std::string, std::string> files;  ///< contents of the files that it names, by the names it gives them

  // solver
  double end_time = 0;  ///< s
  double cell = 0;      ///< edge of the square cells, m
  Plane plane = Plane::strain;
  double thickness = 1e-3;  ///< m
  ShapeFunction shape = ShapeFunction::ugimp;
  Transfer transfer = Transfer::flip;
  int order = 2;            ///< XPIC(k), FMPM(k)
  double pic_fraction = 0;  ///< transfer = pic
  bool affine = false;      ///< particles carry the gradient of their velocity
  StressUpdate stress_update = StressUpdate::usavg;
  double cfl = 0.4;
  double dt_max = std::numeric_limits<double>::infinity();
  ScatterKind scatter = ScatterKind::ordered;  ///< on a CPU at least as fast as atomic, and of fixed order
  Precision precision = Precision::as_double;
  bool deterministic = false;  ///< same bits on any thread count (refuses atomic scatter)
  exec::Kind exec = exec::Kind::openmp;
  int threads = 0;  ///< 0 means all cores

  // grid
  Rectangle grid;  ///< its walls; on multiples of `cell` from the lower corner

  // effects
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<FixedNodes> fixed;
  std::vector<SymmetryPlane> symmetry;
  std::vector<Grip> grips;
  std::vector<Load> loads;
  std::optional<TimeFunction> body_force[2];     ///< acceleration, m/s^2
  std::optional<TimeFunction> grid_damping;      ///< 1/s
  std::optional<TimeFunction> particle_damping;  ///< 1/s
  std::vector<CrackLine> cracks;
  ContactSettings contact;
  ContactRules contact_rules;
  CrackMotion crack_motion = CrackMotion::surfaces;
  SurfaceUpdate surface_update = SurfaceUpdate::xpic;
  FractureRules fracture;
  std::vector<FractureReading> readings;
  std::optional<GrowthRule> growth;  ///< of all cracks that do not say otherwise

  std::vector<Probe> probes;
  Output output;
  Limits limits;

  std::vector<std::string> defaults;  ///< "key = value" of everything that was not said, for the header
  /// Where keys and named things were written: "grid.cell" -> "scene.toml:9: grid.cell", "crack left" -> ...
  std::map<std::string, std::string> places;
};

/// Where `key` or a named part ("crack left") was written; itself when the scene was not read from a file.
std::string place(const Scene& s, const std::string& key);

}  // namespace riven
