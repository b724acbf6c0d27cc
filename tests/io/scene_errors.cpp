// Each thing that can be wrong in a scene: the message names file, line and key, and says what was meant.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/io/scene_text.hpp"

using namespace riven;
using namespace riven::test;

namespace {

struct Wrong {
  const char* name;
  const char *from, *to;     ///< the change to the good scene
  const char *where, *what;  ///< parts of the message
  const char* hint;          ///< part of the rest of it: limit or suggestion
};

void PrintTo(const Wrong& w, std::ostream* out) {
  *out << w.name;
}

const Wrong cases[] = {
    {"syntax", "time = \"2 ms\"", "time = 2 ms", "plate.toml:3", "not TOML", "quotes"},
    {"triple_bracket", "[[crack]]", "[[[crack]]]", "plate.toml:26", "not TOML", "toml.io"},
    {"beyond_ascii", "plane =", "plané =", "plate.toml:4", "not TOML", "texts stand in quotes"},
    {"unknown_key", "plane =", "plnae =", "plate.toml:4: solver.plnae", "unknown key 'plnae'", "'plane'"},
    {"unknown_table", "[grid]", "[gird]", "plate.toml:5: gird", "unknown table 'gird'", "'grid'"},
    {"unknown_array", "[[crack]]", "[[crak]]", "plate.toml:26: crak", "unknown key 'crak'", "'crack'"},
    {"missing_time", "time = \"2 ms\"\n", "", "plate.toml:2: solver.time", "missing key 'time'", "add time"},
    {"missing_cell", "cell = \"0.5 mm\"\n", "", "plate.toml:5: grid.cell", "missing key 'cell'", "add cell"},
    {"missing_E", "E = \"2500 MPa\"\n", "", "plate.toml:9: material.0.E", "missing key 'E'", "add E"},
    {"number_without_unit", "E = \"2500 MPa\"", "E = 2500", "plate.toml:11: material.0.E", "quantity of stress",
     "\"2500 MPa\", or \"2500 Pa\""},
    {"wrong_type", "nu = 0.33", "nu = \"0.33\"", "plate.toml:12: material.0.nu", "expected a number", "without unit"},
    {"not_an_array", "[[crack]]", "[crack]", "plate.toml:26: crack", "array of tables", "[[crack]]"},
    {"wrong_pair", "lower = [\"-4 mm\", \"-4 mm\"]", "lower = [\"-4 mm\"]", "plate.toml:7: grid.lower", "array of two",
     "mm"},
    {"wrong_unit", "2500 MPa", "2500 Mpa", "plate.toml:11: material.0.E", "unknown unit 'Mpa'", "'MPa'"},
    {"wrong_dimension", "\"1 g/cm^3\"", "\"1 g\"", "plate.toml:13: material.0.density", "not a unit of density",
     "kg/m^3"},
    {"unknown_choice", "plane = \"stress\"", "plane = \"stres\"", "plate.toml:4: solver.plane", "unknown name 'stres'",
     "'stress'"},
    {"unknown_precision", "plane =", "precision = \"flaot\"\nplane =", "plate.toml:4: solver.precision",
     "unknown name 'flaot'", "'float'"},
    {"negative_damping", "[grid]", "[damping]\ngrid = \"-20 /ms\"\n[grid]", "plate.toml:6: damping.grid",
     "drives the bodies on", "0 or more"},
    {"resolution_too_fine", "[[crack]]", "[[crack]]\nresolution = \"1 nm\"", "plate.toml:26: crack.0",
     "finer than anything that the grid knows", "2.5 um or more"},
    {"float_too_small", "plane =", "precision = \"float\"\nthickness = \"1e-25 m\"\nplane =",
     "plate.toml:4: solver.precision", "body plate are too small for single precision", "\"double\""},
    {"unknown_material", "material = \"pmma\"", "material = \"pma\"", "plate.toml:16: body.0.material",
     "unknown name 'pma'", "'pmma'"},
    {"no_material", "material = \"pmma\"\n", "", "plate.toml:14: body.0.material", "missing key 'material'", "add"},
    {"negative_density", "\"1 g/cm^3\"", "\"-1 g/cm^3\"", "plate.toml:13: material.0.density", "out of range",
     "greater than 0"},
    {"zero_E", "2500 MPa", "0 MPa", "plate.toml:11: material.0.E", "out of range", "greater than 0"},
    {"nu_half", "0.33", "0.5", "plate.toml:12: material.0.nu", "out of range", "less than 0.5"},
    {"nu_minus_one", "0.33", "-1.0", "plate.toml:12: material.0.nu", "out of range", "greater than -1"},
    {"nu_nan", "0.33", "nan", "plate.toml:12: material.0.nu", "not finite", "less than 0.5"},
    {"E_infinite", "2500 MPa", "inf MPa", "plate.toml:11: material.0.E", "not finite", "stress"},
    {"zero_cell", "\"0.5 mm\"", "\"0 mm\"", "plate.toml:6: grid.cell", "out of range", "greater than 0"},
    {"cfl_zero", "plane =", "cfl = 0\nplane =", "plate.toml:4: solver.cfl", "out of range", "at most 2"},
    {"cfl_tiny", "plane =", "cfl = -1e-300\nplane =", "plate.toml:4: solver.cfl", "out of range", "greater than 0"},
    {"cfl_list", "plane =", "cfl = [1e-300, -inf]\nplane =", "plate.toml:4: solver.cfl", "found an array", "a number"},
    {"seventeen_per_cell", "material = \"pmma\"", "particles_per_cell = 17\nmaterial = \"pmma\"",
     "plate.toml:16: body.0.particles_per_cell", "out of range", "from 1 to 16"},
    {"velocity_twice", "material = \"pmma\"",
     "velocity = [\"1 m/s\", \"0 m/s\"]\nvelocity_x = \"1 m/s\"\nmaterial = \"pmma\"",
     "plate.toml:17: body.0.velocity_x", "said twice", "velocity_x and velocity_y"},
    {"unknown_word_in_field", "material = \"pmma\"",
     "velocity_x = { value = \"1 m/s\", shape = \"sin(X/Lx)\", L = \"1 m\" }\nmaterial = \"pmma\"",
     "plate.toml:16: body.0.velocity_x", "cannot be read", "t, pi, X, Y"},
    {"constant_without_dimension", "material = \"pmma\"",
     "velocity_x = { value = \"1 m/s\", shape = \"sin(X/L)\", L = \"1 mol\" }\nmaterial = \"pmma\"",
     "plate.toml:16: body.0.velocity_x", "no quantity has the unit 'mol'", "m/s"},
    {"place_in_a_time_function", "sin(pi*t/tr)", "sin(pi*X/tr)", "grip.0.velocity_y", "cannot be read",
     "the named constants, t, pi, sin"},
    {"constant_with_a_taken_name", "[solver]", "[constants]\nX = 1\n[solver]", "constants.X", "name of a constant",
     "letters, digits"},
    {"constant_of_unknown_unit", "[solver]", "[constants]\nL = \"1 furlongs per\"\n[solver]", "constants.L",
     "unknown unit", "kg/m^3"},
    {"constant_of_no_kind", "[solver]", "[constants]\nL = true\n[solver]", "constants.L", "no constant", "a number"},
    {"constants_no_table", "title = \"plate\"", "title = \"plate\"\nconstants = 1", "constants", "a table of constants",
     ""},
    {"force_in_an_acceleration", "[[crack]]",
     "[[load]]\nkind = \"acceleration\"\nrectangle = { lower = [\"0 mm\", \"0 mm\"], upper = [\"9 mm\", \"9 mm\"] }\n"
     "force_x = \"1 N\"\n[[crack]]",
     "load.0.force_x", "no such component", "did you mean 'acceleration_x'?"},
    {"edge_of_an_acceleration", "[[crack]]",
     "[[load]]\nkind = \"acceleration\"\nrectangle = { lower = [\"0 mm\", \"0 mm\"], upper = [\"9 mm\", \"9 mm\"] }\n"
     "acceleration_x = \"1 m/s^2\"\nedge = \"top\"\n[[crack]]",
     "load.0.edge", "has no edge", "traction"},
    {"error_of_nothing", "[[crack]]", "[[probe]]\nname = \"e\"\nkind = \"displacement_error\"\n[[crack]]", "probe.0",
     "the exact displacement is missing", "exact_x"},
    {"exact_stress", "[[crack]]", "[[probe]]\nname = \"e\"\nkind = \"mean_stress\"\nexact_x = \"1 mm\"\n[[crack]]",
     "probe.0.exact_x", "has no exact_x", ""},
    {"bonds_cannot_wait", "contact = { law = \"coulomb\", friction = 0.3 }",
     "contact = { law = \"bonded\" }\n[contact]\nwhen = \"auto\"", "crack.0", "cannot wait", "\"always\""},
    {"contact_sometimes", "[[crack]]", "[contact]\nwhen = \"atuo\"\n[[crack]]", "contact.when", "unknown name 'atuo'",
     "'auto'"},
    {"half_per_cell", "material = \"pmma\"", "particles_per_cell = 1.5\nmaterial = \"pmma\"",
     "plate.toml:16: body.0.particles_per_cell", "expected a whole number", ""},
    {"no_region", "rectangle = { lower = [\"0 mm\", \"0 mm\"]", "holes = [] #", "plate.toml:14: body.0",
     "region is missing", "rectangle, disk or polygon"},
    {"two_regions", "material = \"pmma\"",
     "disk = { center = [\"9 mm\", \"9 mm\"], radius = \"1 mm\" }\nmaterial = \"pmma\"", "plate.toml:14: body.0",
     "said twice", "rectangle, disk or polygon"},
    {"flat_rectangle", "upper = [\"50 mm\", \"100 mm\"]", "upper = [\"50 mm\", \"0 mm\"]",
     "plate.toml:17: body.0.rectangle.upper", "no area", "greater than lower"},
    {"flat_polygon", "rectangle = { lower = [\"0 mm\", \"0 mm\"], upper = [\"50 mm\", \"100 mm\"] }",
     "polygon = [[\"0 mm\", \"0 mm\"], [\"5 mm\", \"5 mm\"], [\"9 mm\", \"9 mm\"]]", "plate.toml:14: body.0", "no area",
     "corners in order"},
    {"tiny_body", "upper = [\"50 mm\", \"100 mm\"]", "upper = [\"50 mm\", \"0.2 mm\"]", "plate.toml:14: body.0",
     "too small to hold a particle", "0.25 mm"},
    {"small_grid", "upper = [\"54 mm\", \"104 mm\"]", "upper = [\"54 mm\", \"90 mm\"]", "plate.toml:14: body.0",
     "grid is too small", "(54, 90) mm"},
    {"grip_leaves", "\"1 m/s\"", "\"10 m/s\"", "plate.toml:22: grip.0", "moves out of it", "larger grid"},
    {"grid_upside_down", "upper = [\"54 mm\", \"104 mm\"]", "upper = [\"54 mm\", \"-10 mm\"]",
     "plate.toml:8: grid.upper", "no area", "greater than lower"},
    {"broken_cells", "upper = [\"54 mm\", \"104 mm\"]", "upper = [\"54.2 mm\", \"104 mm\"]", "plate.toml:8: grid.upper",
     "not a whole number of cells", "(54, 104) mm"},
    {"huge_grid", "cell = \"0.5 mm\"", "cell = \"1 nm\"", "plate.toml:6: grid.cell", "grid is too large",
     "larger cells"},
    {"off_line", "position = \"0 mm\"", "position = \"0.2 mm\"", "plate.toml:18: symmetry.0", "not on a grid line",
     "\"0 mm\""},
    {"beyond_plane", "position = \"0 mm\"", "position = \"10 mm\"", "plate.toml:14: body.0", "beyond a symmetry plane",
     "x at least 10 mm"},
    {"outside_plane", "position = \"0 mm\"", "position = \"-5 mm\"", "plate.toml:18: symmetry.0", "not on a grid line",
     "up to 54 mm"},
    {"duplicate_material", "[[body]]",
     "[[material]]\nname = \"pmma\"\nE = \"1 Pa\"\nnu = 0\ndensity = \"1 kg/m^3\"\n[[body]]",
     "plate.toml:14: material.1", "same name", "a name for each"},
    {"bad_name", "name = \"edge\"", "name = \"a,b\"", "plate.toml:27: crack.0.name", "character", "letters"},
    {"coulomb_without_friction", ", friction = 0.3", "", "plate.toml:29: crack.0.contact.friction",
     "missing key 'friction'", "add friction"},
    {"friction_without_coulomb", "law = \"coulomb\"", "law = \"stick\"", "plate.toml:29: crack.0.contact.friction",
     "'stick' has no friction", "coulomb"},
    {"interface_without_stiffness", "law = \"coulomb\", friction = 0.3", "law = \"interface\"",
     "plate.toml:29: crack.0.contact.normal_stiffness", "missing key 'normal_stiffness'", "add"},
    {"interface_of_no_stiffness", "law = \"coulomb\", friction = 0.3",
     "law = \"interface\", normal_stiffness = \"0 Pa/m\", shear_stiffness = \"1 Pa/m\"", "plate.toml:26: crack.0",
     "normal stiffness", "greater than 0"},
    {"crack_outside", "points = [[\"-1 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]",
     "points = [[\"-1 mm\", \"50 mm\"], [\"-1 mm\", \"70 mm\"]]", "plate.toml:26: crack.0",
     "no part of the crack lies in a body", "through a body"},
    {"crack_twice", "[[crack]]",
     "[[crack]]\nname = \"part\"\npoints = [[\"20 mm\", \"50 mm\"], [\"10 mm\", \"50 mm\"]]\n[[crack]]",
     "plate.toml:26: crack.0", "lies on another one, crack edge", "only one"},
    {"crack_beside", "[[crack]]",
     "[[crack]]\nname = \"part\"\npoints = [[\"20 mm\", \"50.1 mm\"], [\"10 mm\", \"50.1 mm\"]]\n[[crack]]",
     "plate.toml:26: crack.0", "all along crack edge with no particle between", "only one"},
    {"crack_folded", ", [\"25 mm\", \"50 mm\"]]", ", [\"25 mm\", \"50 mm\"], [\"15 mm\", \"50 mm\"]]",
     "plate.toml:26: crack.0", "turns back and lies on itself", "in their order"},
    {"crack_off_grid", "[\"-1 mm\", \"50 mm\"]", "[\"-9 mm\", \"50 mm\"]", "plate.toml:26: crack.0",
     "the crack leaves it", "larger grid"},
    {"crack_without_length", "[\"-1 mm\", \"50 mm\"]", "[\"25 mm\", \"50 mm\"]", "plate.toml:26: crack.0",
     "without length", "differ"},
    {"crack_of_one_point", ", [\"25 mm\", \"50 mm\"]", "", "plate.toml:28: crack.0.points", "at least 2 points", ""},
    {"crack_without_points", "points = [[\"-1 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]\n", "",
     "plate.toml:26: crack.0", "no points", "points or file"},
    {"traction_without_kind", "contact = {", "traction = { pressure = \"5 MPa\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.kind", "missing key 'kind'", "add kind"},
    {"traction_of_unknown_kind", "contact = {", "traction = { kind = \"presure\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.kind", "unknown name 'presure'", "'pressure'"},
    {"pressure_without_value", "contact = {", "traction = { kind = \"pressure\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.pressure", "missing key 'pressure'", "5 MPa"},
    {"pressure_with_strength", "contact = {",
     "traction = { kind = \"pressure\", pressure = \"1 MPa\", strength = \"1 MPa\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.strength", "'pressure' has no strength", "triangular"},
    {"cohesive_without_strength", "contact = {",
     "traction = { kind = \"triangular\", toughness = \"1 N/mm\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.strength", "missing key 'strength'", "add strength"},
    {"cohesive_without_toughness", "contact = {",
     "traction = { kind = \"triangular\", strength = \"1 MPa\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.toughness", "missing key 'toughness'", "add toughness"},
    {"toughness_of_wrong_unit", "contact = {",
     "traction = { kind = \"triangular\", strength = \"1 MPa\", toughness = \"1 MPa\" }\ncontact = {",
     "plate.toml:29: crack.0.traction.toughness", "not a unit of energy release rate", "J/m^2"},
    {"triangle_with_knee", "contact = {",
     "traction = { kind = \"triangular\", strength = \"1 MPa\", toughness = \"1 N/mm\", knee = 0.5 }\ncontact = {",
     "plate.toml:29: crack.0.traction.knee", "'triangular' has no knee", "trilinear"},
    {"triangle_with_decay", "contact = {",
     "traction = { kind = \"triangular\", strength = \"1 MPa\", toughness = \"1 N/mm\", decay = 5 }\ncontact = {",
     "plate.toml:29: crack.0.traction.decay", "'triangular' has no decay", "exponential"},
    {"knee_before_peak", "contact = {",
     "traction = { kind = \"trilinear\", strength = \"1 MPa\", toughness = \"1 N/mm\", peak = 0.4 }\ncontact = {",
     "plate.toml:29: crack.0.traction.peak", "before its peak", "greater than peak"},
    {"peak_at_the_end", "contact = {",
     "traction = { kind = \"triangular\", strength = \"1 MPa\", toughness = \"1 N/mm\", peak = 1 }\ncontact = {",
     "plate.toml:29: crack.0.traction.peak", "out of range", "less than 1"},
    {"traction_beside_crack", "contact = {",
     "traction = { kind = \"pressure\", pressure = \"1 MPa\", disk = { center = [\"9 mm\", \"9 mm\"], radius = \"1 "
     "mm\" "
     "} }\ncontact = {",
     "plate.toml:26: crack.0", "lies in the region of its traction", "passes through"},
    {"traction_on_joined_faces", "contact = { law = \"coulomb\", friction = 0.3 }",
     "traction = { kind = \"pressure\", pressure = \"1 MPa\" }\ncontact = { law = \"bonded\" }",
     "plate.toml:26: crack.0", "faces that contact joins", "frictionless"},
    {"grip_without_velocity", "velocity_y = { value = \"1 m/s\", shape = \"sin(pi*t/tr)\", tr = \"2 ms\" }\n", "",
     "plate.toml:22: grip.0", "needs a velocity", "velocity_x"},
    {"shape_missing", "shape = \"sin", "shpe = \"sin", "plate.toml:25: grip.0.velocity_y", "needs the key 'shape'",
     "sin(t/tr)"},
    {"shape_unreadable", "sin(pi*t/tr)", "sin(pi*t/ts)", "plate.toml:25: grip.0.velocity_y", "cannot be read",
     "did you mean 't'? A constant of its own stands beside the expression: ts = "},
    {"shape_with_unit", "sin(pi*t/tr)", "t < 0.298 ms ? 1 : 0", "plate.toml:25: grip.0.velocity_y", "cannot be read",
     "beside the expression: t1 = \"0.298 ms\", and t1 in it"},
    {"shape_with_unit_at_once", "sin(pi*t/tr)", "t/25us", "plate.toml:25: grip.0.velocity_y", "cannot be read",
     "t1 = \"25 us\""},
    {"shape_with_unit_of_a_power", "sin(pi*t/tr)", "min(t/2.5e-3 ms, 1)", "plate.toml:25: grip.0.velocity_y",
     "cannot be read", "t1 = \"2.5e-3 ms\""},
    {"shape_with_unit_of_a_name", "sin(pi*t/tr)", "t < tr2 ms ? 1 : 0", "plate.toml:25: grip.0.velocity_y",
     "cannot be read", "beside the expression: tr2 = "},
    {"shape_with_if", "sin(pi*t/tr)", "if(t < tr, 1, 0)", "plate.toml:25: grip.0.velocity_y", "cannot be read",
     "condition ? this : that"},
    {"shape_not_finite", "sin(pi*t/tr)", "tr/t", "plate.toml:25: grip.0.velocity_y", "not finite at t = 0", "end"},
    {"odd_reading", "[[crack]]", "[fracture]\n[[fracture.reading]]\nname = \"near\"\ncontour = 3\n[[crack]]",
     "plate.toml:29: fracture.reading.0.contour", "no node in its middle", "contour = 4"},
    {"nameless_reading", "[[crack]]", "[fracture]\n[[fracture.reading]]\ncontour = 8\n[[crack]]",
     "plate.toml:27: fracture.reading.0.name", "missing key 'name'", "add name"},
    {"readings_of_one_name", "[[crack]]",
     "[fracture]\nreading = [{ name = \"far\", contour = 8 }, { name = \"far\", contour = 12 }]\n[[crack]]",
     "plate.toml:27: fracture.reading.1.name", "two readings", "of its own"},
    {"growth_without_toughness", "name = \"edge\"", "name = \"edge\"\ngrowth = {}",
     "plate.toml:28: crack.0.growth.toughness", "missing key 'toughness'", "add toughness"},
    {"crack_on_a_symmetry_plane", "[[\"-1 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]",
     "[[\"0 mm\", \"20 mm\"], [\"0 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]", "plate.toml:26: crack.0",
     "lies on a symmetry plane", "both halves of the solid"},
    {"growth_without_J_Ic", "name = \"edge\"", "name = \"edge\"\ngrowth = { criterion = \"critical_j\" }",
     "plate.toml:28: crack.0.growth.toughness", "material 'pmma' has no J_Ic", "or J_Ic to each material"},
    {"K_Ic_as_energy", "nu = 0.33", "nu = 0.33\nK_Ic = \"300 J/m^2\"", "plate.toml:13: material.0.K_Ic",
     "not a unit of toughness", "MPa m^0.5"},
    {"toughness_without_root", "name = \"edge\"", "name = \"edge\"\ngrowth = { toughness = \"1 MPa\" }",
     "plate.toml:28: crack.0.growth.toughness", "not a unit of toughness", "MPa m^0.5"},
    {"toughness_of_no_size", "name = \"edge\"", "name = \"edge\"\ngrowth = { toughness = \"0 MPa sqrt(m)\" }",
     "plate.toml:28: crack.0.growth.toughness", "out of range", "greater than 0"},
    {"critical_j_as_toughness", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { criterion = \"critical_j\", toughness = \"1 MPa sqrt(m)\" }",
     "plate.toml:28: crack.0.growth.toughness", "unit", "J/m^2"},
    {"unknown_criterion", "name = \"edge\"", "name = \"edge\"\ngrowth = { criterion = \"kmax\" }",
     "plate.toml:28: crack.0.growth.criterion", "unknown name 'kmax'", "'k_max'"},
    {"fixed_without_heading", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { toughness = \"1 Pa sqrt(m)\", direction = \"fixed\" }",
     "plate.toml:28: crack.0.growth.heading", "missing key 'heading'", "add heading"},
    {"heading_nowhere", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { toughness = \"1 Pa sqrt(m)\", direction = \"fixed\", heading = [0, 0] }",
     "plate.toml:28: crack.0.growth.heading", "points nowhere", "[1, 0]"},
    {"heading_of_texts", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { toughness = \"1 Pa sqrt(m)\", direction = \"fixed\", heading = [\"1\", 0] }",
     "plate.toml:28: crack.0.growth.heading", "two numbers", "[1, 0]"},
    {"heading_for_hoop", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { toughness = \"1 Pa sqrt(m)\", heading = [1, 0] }",
     "plate.toml:28: crack.0.growth.heading", "'hoop' has no heading", "fixed"},
    {"speed_limit_zero", "name = \"edge\"",
     "name = \"edge\"\ngrowth = { toughness = \"1 Pa sqrt(m)\", speed_limit = \"0 m/s\" }",
     "plate.toml:28: crack.0.growth.speed_limit", "out of range", "greater than 0"},
    {"grows_and_does_not", "name = \"edge\"",
     "name = \"edge\"\ngrows = false\ngrowth = { toughness = \"1 Pa sqrt(m)\" }", "plate.toml:28: crack.0.grows",
     "does not grow", "grows = false"},
    {"growth_without_tip", "[\"25 mm\", \"50 mm\"]]",
     "[\"51 mm\", \"50 mm\"]]\ngrowth = { toughness = \"1 Pa sqrt(m)\" }", "plate.toml:26: crack.0", "no tip in a body",
     "inside a body"},
    {"time_of_wrong_unit", "tr = \"2 ms\"", "tr = \"2 mm\"", "plate.toml:25: grip.0.velocity_y", "not a unit of time",
     "did you mean 'ms'"},
};

}  // namespace

class BadScene : public ::testing::TestWithParam<Wrong> {};

TEST_P(BadScene, SaysFileLineKeyAndWhatIsAllowed) {
  const Wrong& w = GetParam();
  const Trouble t = trouble_of(changed(w.from, w.to));
  EXPECT_EQ(t.code, Exit::bad_input);
  EXPECT_NE(t.where.find(w.where), std::string::npos) << Error(t).what();
  EXPECT_NE(t.what.find(w.what), std::string::npos) << Error(t).what();
  EXPECT_NE((t.limit + "\n" + t.suggestion).find(w.hint), std::string::npos) << Error(t).what();
}

INSTANTIATE_TEST_SUITE_P(Scene, BadScene, ::testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

/// More than a scene may have.
std::string many_bodies() {
  std::string text;
  for (int k = 0; k < 256; ++k)
    text += fmt::format(
        "[[body]]\nmaterial = \"pmma\"\ndisk = {{ center = [\"{} mm\", \"9 mm\"], radius = \"1 mm\" }}\n", 60 + 3 * k);
  return text;
}

TEST(BadSceneParts, EachIsRefused) {
  struct Extra {
    std::string text;
    const char *what, *hint;
  };
  const Extra extras[] = {
      {"[[body]]\nname = \"plate\"\nmaterial = \"pmma\"\ndisk = { center = [\"9 mm\", \"9 mm\"], radius = \"1 mm\" }\n",
       "same name", "each"},
      {"[[body]]\nmaterial = \"pmma\"\ndisk = { center = [\"9 mm\", \"9 mm\"], radius = \"1 mm\" }\n",
       "in the same place", "a hole"},
      {"[[body]]\nmaterial = \"pmma\"\ndisk = { center = [\"52 mm\", \"9 mm\"], radius = \"1 mm\" }\n"
       "holes = [ { disk = { center = [\"9 mm\", \"9 mm\"], radius = \"1 mm\" } } ]\n",
       "outside its body", "mm"},
      {"[[fix]]\nbox = { lower = [\"0.1 mm\", \"0 mm\"], upper = [\"0.2 mm\", \"1 mm\"] }\nvelocity_x = \"0 m/s\"\n",
       "no grid node", "grid line"},
      {"[[fix]]\nname = \"top\"\nbox = { lower = [\"0 mm\", \"0 mm\"], upper = [\"0 mm\", \"9 mm\"] }\n"
       "velocity_x = \"0 m/s\"\n",
       "a grip and a fix have the same name", "each"},
      {many_bodies(), "too many bodies", "at most 256"},
      {"[[load]]\nkind = \"force\"\nrectangle = { lower = [\"51 mm\", \"0 mm\"], upper = [\"52 mm\", \"9 mm\"] }\n"
       "force_x = \"1 N\"\n",
       "lies on no body", "particles"},
      {"[[load]]\nkind = \"force\"\nrectangle = { lower = [\"1 mm\", \"0 mm\"], upper = [\"2 mm\", \"9 mm\"] }\n"
       "traction_x = \"1 MPa\"\n",
       "no such component", "'force_x'"},
      {"[[load]]\nkind = \"pressure\"\n", "unknown name 'pressure'", "force, traction"},
      {"[[body]]\nmaterial = \"pmma\"\ndisk = { center = [\"52 mm\", \"9 mm\"], radius = \"1 mm\" }\n"
       "thickness = \"7 mm\"\n[[crack]]\npoints = [[\"9 mm\", \"9 mm\"], [\"19 mm\", \"9 mm\"]]\n"
       "contact = { law = \"interface\", normal_stiffness = \"1 MPa/mm\", shear_stiffness = \"1 MPa/mm\" }\n",
       "the thickness of the scene", "none of the body's own"},
      {"[[probe]]\nkind = \"crack_opening\"\ntarget = \"egde\"\n", "unknown name 'egde'", "'edge'"},
      {"[[probe]]\nkind = \"reaction\"\ntarget = \"tob\"\n", "unknown name 'tob'", "'top'"},
      {"[[probe]]\nkind = \"displacement\"\n", "missing key 'point'", "add point"},
      {"[[probe]]\nkind = \"velocity\"\npoint = [\"-3 mm\", \"0 mm\"]\n", "lies on no body", "in a body"},
      {"[[probe]]\nkind = \"stress\"\npoint = [\"3 mm\", \"0 mm\"]\naxis = \"x\"\n", "has no axis", ""},
      {"[[probe]]\nname = \"strain\"\nkind = \"reaction\"\ntarget = \"top\"\n", "column of this name", "of its own"},
      {"[[probe]]\nname = \"fracture\"\nkind = \"reaction\"\ntarget = \"top\"\n", "column of this name", "fracture_1"},
      {"[output]\nfields = [\"fringes\"]\n", "unknown field 'fringes'", "'fringe'"},
      {"[output]\nfields = [\"fringe\"]\n", "needs its constant", "fringe_constant"},
      {"[contact]\nv_sep = 1.2\n", "apart and in contact", "at most v_contact"},
      {"[[crack]]\npoints = [[\"9 mm\", \"9 mm\"], [\"19 mm\", \"9 mm\"]]\n[crack.traction]\nkind = \"exponential\"\n"
       "strength = \"1 MPa\"\ntoughness = \"1 N/mm\"\n[cracks]\nsurface_update = \"flip\"\n",
       "gain energy", "xpic"},
      {"[damping]\ngrid = \"80 ms\"\n", "not a unit of rate", "1/ms"},
      {"[growth]\ncriterion = \"k_max\"\n", "missing key 'toughness'", "add toughness"},
      {"[limits]\nenergy_growth = inf\n", "not finite", "greater than 0"},
      {"[limits]\nretries = -1\n", "out of range", "0 to 1000"},
      {"[limits]\nretries = 0.5\n", "whole number", "whole number"},
      {"[limits]\nretries = 1\nretry_cfl = 1\n", "out of range", "less than 1"},
      {"[limits]\nretries = 1\nretry_cfl = 0\n", "out of range", "greater than 0"},
      {"[limits.warn]\nenergi = 0.1\n", "unknown key 'energi'", "'energy'"},
      {"[limits.stop]\npenetration = 0\n", "out of range", "greater than 0"},
      {"[limits.warn]\nvelocity_difference = 3\n", "quantity of speed", "m/s"},
      {"[limits.stop]\nexpansion = \"2\"\n", "found a text", "without unit"},
      {"[limits]\nretris = 1\n", "unknown key 'retris'", "'retries'"},
  };
  for (const Extra& e : extras) {
    const Trouble t = trouble_of(good_scene + e.text);
    EXPECT_EQ(t.code, Exit::bad_input);
    EXPECT_TRUE(t.where.starts_with("plate.toml:")) << Error(t).what();
    EXPECT_NE(t.what.find(e.what), std::string::npos) << Error(t).what();
    EXPECT_NE((t.limit + "\n" + t.suggestion).find(e.hint), std::string::npos) << Error(t).what();
  }
}

TEST(BadSceneParts, GrowthNeedsATip) {
  const std::string growth = "[growth]\ntoughness = \"1 MPa m^0.5\"\n";
  read(good_scene + growth);
  for (const std::string& text : {changed("[\"25 mm\", \"50 mm\"]]", "[\"50 mm\", \"50 mm\"]]") + growth,
                                  changed("name = \"edge\"", "name = \"edge\"\ngrows = false") + growth}) {
    const Trouble t = trouble_of(text);
    EXPECT_EQ(t.code, Exit::bad_input);
    EXPECT_TRUE(t.where.starts_with("plate.toml:")) << Error(t).what();
    EXPECT_NE(t.what.find("has a tip in a body"), std::string::npos) << Error(t).what();
  }
}

/// However short its pieces are beside the cells.
TEST(BadSceneParts, ACrackMayBeCutAsFinelyAsOneLikes) {
  std::string straight, arc;
  for (int k = 0; k <= 3000; ++k)
    straight += fmt::format("[\"{:.17g} mm\", \"30 mm\"], ", 30 + 10. * k / 3000);
  for (int k = 0; k <= 150; ++k) {
    const double angle = std::numbers::pi * k / 150;
    arc += fmt::format("[\"{:.17g} mm\", \"{:.17g} mm\"], ", 20 + std::cos(angle), 20 + std::sin(angle));
  }
  for (const std::string& points : {straight, arc, std::string{R"(["20 mm", "30 mm"], ["30 mm", "30 mm"],
                                                                  ["30.002 mm", "30 mm"])"}})
    read(fmt::format("{}[[crack]]\nname = \"fine\"\npoints = [{}]\n", good_scene, points));
}

TEST(BadSceneParts, ACrackMayCloseAnotherToARing) {
  const auto crack = [](const char* name, const char* points) {
    return fmt::format("[[crack]]\nname = \"{}\"\npoints = [{}]\n", name, points);
  };
  const std::string three_sides = crack("sides", R"(["30 mm", "30 mm"], ["30 mm", "40 mm"], ["40 mm", "40 mm"],
                                                    ["40 mm", "30 mm"])");
  read(good_scene + three_sides + crack("fourth", R"(["30 mm", "30 mm"], ["40 mm", "30 mm"])"));
  const Trouble t = trouble_of(good_scene + three_sides + crack("first", R"(["30 mm", "32 mm"], ["30 mm", "39 mm"])"));
  EXPECT_NE(t.what.find("lies on another one, crack sides"), std::string::npos) << Error(t).what();
}

TEST(BadSceneParts, JNeedsATip) {
  const std::string fracture = "[fracture]\ncontour = 8\n";
  read(good_scene + fracture);
  const Trouble t = trouble_of(changed("[\"25 mm\", \"50 mm\"]]", "[\"50 mm\", \"50 mm\"]]") + fracture);
  EXPECT_EQ(t.code, Exit::bad_input);
  EXPECT_TRUE(t.where.starts_with("plate.toml:")) << Error(t).what();
  EXPECT_NE(t.what.find("has a tip in a body"), std::string::npos) << Error(t).what();
}

/// So deep that whatever walks through it would come to the end of its stack.
TEST(BadSceneParts, WhatIsNestedTooDeeplyIsRefused) {
  const auto times = [](int n, const std::string& piece) {
    std::string text;
    for (int k = 0; k < n; ++k)
      text += piece;
    return text;
  };
  constexpr int n = 50'000;
  const std::string start = "# one\n# two\n";
  for (const auto& [text, allowed] : std::vector<std::pair<std::string, std::string>>{
           {"[a" + times(n, ".a") + "]\n", "32 parts of a key"},
           {"[[a" + times(n, " . 'a.b'") + "]]\n", "32 parts of a key"},
           {"a" + times(n, ".a") + " = 1\n", "32 parts of a key"},
           {"a = { \"b\"" + times(n, ".\"b\"") + " = 1 }\n", "32 parts of a key"},
           {"a = [\"\"\" \"\"\"\"\", { b" + times(n, ".b") + " = 1 }]\n", "32 parts of a key"},
           {"a = " + times(n, "[") + times(n, "]") + "\n", "32 arrays and tables"},
           {"a = " + times(n, "{ a = ") + "1" + times(n, " }") + "\n", "32 arrays and tables"}}) {
    const Trouble t = trouble_of(start + text);
    EXPECT_EQ(t.code, Exit::bad_input);
    EXPECT_EQ(t.where, "plate.toml:3");
    EXPECT_NE(t.limit.find("at most " + allowed), std::string::npos) << Error(t).what();
    EXPECT_LT(std::string(Error(t).what()).size(), 200u);
  }
  const std::string points = times(n, ".");
  read("# " + points + "\n" +
       changed("title = \"plate\"", "title = \"\"\"\n\\\"" + points + "'\n[[" + points + "\"\"\"") + "# \"" + points);
}

TEST(BadSceneFile, IsAFileError) {
  const auto code = [](const std::string& path) {
    try {
      read_scene(path);
    } catch (const Error& e) {
      EXPECT_NE(e.trouble().value.find(path), std::string::npos);
      return e.code();
    }
    return Exit::done;
  };
  EXPECT_EQ(code("no/such/scene.toml"), Exit::file);
  EXPECT_EQ(code(std::filesystem::temp_directory_path().string()), Exit::file);
  EXPECT_EQ(code("/dev/zero"), Exit::file);
}

TEST(BadSceneFile, EmptySceneSaysWhatIsMissing) {
  EXPECT_NE(trouble_of("").what.find("missing key 'time'"), std::string::npos);
}
