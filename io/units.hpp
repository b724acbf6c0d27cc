// Physical quantities written as text with a unit, converted to SI and checked for dimension (UDUNITS-2).
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace riven {

/// What a quantity measures: its SI unit, and units that people write, for suggestions.
struct Dimension {
  const char* name;
  const char* si;
  std::vector<std::string> usual;
};

namespace dimension {
inline const Dimension time{"time", "s", {"s", "ms", "us"}};
inline const Dimension length{"length", "m", {"mm", "m", "um", "cm"}};
inline const Dimension area{"area", "m^2", {"mm^2", "m^2", "cm^2"}};
inline const Dimension speed{"speed", "m/s", {"m/s", "mm/s", "mm/ms"}};
inline const Dimension acceleration{"acceleration", "m/s^2", {"m/s^2", "mm/s^2"}};
inline const Dimension stress{"stress", "Pa", {"MPa", "GPa", "kPa", "Pa"}};
inline const Dimension density{"density", "kg/m^3", {"kg/m^3", "g/cm^3"}};
inline const Dimension force{"force", "N", {"N", "mN", "kN"}};
inline const Dimension rate{"rate", "1/s", {"1/s", "1/ms"}};
inline const Dimension angular_velocity{"angular velocity", "rad/s", {"rad/s", "rad/ms", "rpm"}};
inline const Dimension interface_stiffness{"interface stiffness", "Pa/m", {"MPa/mm", "GPa/mm", "Pa/m"}};
inline const Dimension energy_release{"energy release rate", "J/m^2", {"J/m^2", "kJ/m^2", "N/mm"}};
inline const Dimension stress_optic{"stress-optic constant", "1/Pa", {"1/MPa", "1/Pa"}};
}  // namespace dimension

/// "2.5 GPa" -> 2.5e9. The value is in SI units of `d`. Powers in units are whole numbers; units with an offset or a
/// logarithm are refused. Throws Error (bad_input, `where` left empty) when the text is not a finite number followed by
/// a unit of that dimension.
double parse_quantity(std::string_view text, const Dimension& d);

/// A quantity of any of the dimensions above, in its SI unit; errors as parse_quantity.
double parse_any_quantity(std::string_view text);

/// The number that is the whole text, where it is one.
std::optional<double> plain_number(std::string_view text);

/// "0.5 MPa m^0.5", "0.5 MPa sqrt(m)", "16 N/mm^1.5" -> Pa m^0.5. Half powers are allowed and the dimension is
/// checked through the square of the unit. Errors as parse_quantity.
double parse_toughness(std::string_view text);

}  // namespace riven
