#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "io/units.hpp"

using namespace riven;

namespace {

std::string refusal(const char* text, const Dimension& d) {
  try {
    parse_quantity(text, d);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    return e.what();
  }
  return {};
}

}  // namespace

TEST(Units, ConvertToSi) {
  EXPECT_DOUBLE_EQ(parse_quantity("2.5 GPa", dimension::stress), 2.5e9);
  EXPECT_DOUBLE_EQ(parse_quantity("50mm", dimension::length), 0.05);
  EXPECT_DOUBLE_EQ(parse_quantity("-1e-3 m", dimension::length), -1e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("+3 µm", dimension::length), 3e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("1.5 g/cm^3", dimension::density), 1500);
  EXPECT_DOUBLE_EQ(parse_quantity("1 g cm-3", dimension::density), 1000);
  EXPECT_DOUBLE_EQ(parse_quantity("1 kg/m³", dimension::density), 1);
  EXPECT_DOUBLE_EQ(parse_quantity("80 1/ms", dimension::rate), 8e4);
  EXPECT_DOUBLE_EQ(parse_quantity("80 /ms", dimension::rate), 8e4);
  EXPECT_DOUBLE_EQ(parse_quantity("80 ms^-1", dimension::rate), 8e4);
  EXPECT_DOUBLE_EQ(parse_quantity("9.81 m/s^2", dimension::acceleration), 9.81);
  EXPECT_DOUBLE_EQ(parse_quantity("2 J/(m^2 mm)", dimension::stress), 2000);
  EXPECT_DOUBLE_EQ(parse_quantity("60 rpm", dimension::angular_velocity), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("3 rad/ms", dimension::angular_velocity), 3000);
  EXPECT_DOUBLE_EQ(parse_quantity("2 MPa/mm", dimension::interface_stiffness), 2e9);
  EXPECT_DOUBLE_EQ(parse_quantity("0.0889 1/MPa", dimension::stress_optic), 0.0889e-6);
  EXPECT_DOUBLE_EQ(parse_quantity(".4 mN", dimension::force), 4e-4);
}

TEST(Units, WrongDimensionIsRefused) {
  EXPECT_NE(refusal("1 mm", dimension::time).find("not a unit of time"), std::string::npos);
  EXPECT_NE(refusal("1 1/s", dimension::time).find("not a unit of time"), std::string::npos)
      << "a unit and its reciprocal are not the same";
  EXPECT_NE(refusal("1 kg", dimension::density).find("not a unit of density"), std::string::npos);
  EXPECT_NE(refusal("1 MPa mm", dimension::stress).find("not a unit of stress"), std::string::npos);
  for (const char* text : {"1 Hz", "2 kHz", "1 hertz"})
    EXPECT_NE(refusal(text, dimension::angular_velocity).find("counts turns"), std::string::npos) << text;
}

TEST(Units, UnknownUnitIsRefusedWithTheNearest) {
  EXPECT_NE(refusal("1 Mpa", dimension::stress).find("did you mean 'MPa'"), std::string::npos);
  EXPECT_NE(refusal("1 mmm", dimension::length).find("did you mean 'mm'"), std::string::npos);
  EXPECT_NE(refusal("1 zorkmid", dimension::length).find("unknown unit 'zorkmid'"), std::string::npos);
}

TEST(Units, FractionalPowersAreRefused) {
  for (const char* text : {"1 m^0.5", "1 m^(1/2)", "1 m0.5", "1 m**0.5", "1 MPa m^0.5", "1 m^1.0", "1 m^-0.5"})
    EXPECT_NE(refusal(text, dimension::length).find("power that is not a whole number"), std::string::npos) << text;
  for (const char* text : {"1 m^1/2", "1 m1/2", "1 2 m", "1 0.5 m", "1/2 m", "1 m 2"})
    EXPECT_NE(refusal(text, dimension::length).find("number in it"), std::string::npos) << text;
}

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text : {"",
                           " ",
                           "mm",
                           "1",
                           "1 ",
                           "nan mm",
                           "inf mm",
                           "1e999 mm",
                           "1e308 Gm",
                           "--1 mm",
                           "1 mm; 2 mm",
                           "1 lg(re 1 m)",
                           "1 m @ 3",
                           "1 m since 3",
                           "1 ^",
                           "1 *",
                           "1 /",
                           "1 ()",
                           "1 m^999999999",
                           "1 ((((((m",
                           "1 \xff",
                           "1 m^",
                           "1 m**"})
    EXPECT_FALSE(refusal(text, dimension::length).empty()) << text;
  EXPECT_FALSE(refusal("20 degC", dimension::time).empty());
  EXPECT_FALSE(refusal(std::string(100000, '(').insert(0, "1 ").c_str(), dimension::length).empty());
}

TEST(Units, ToughnessIsCheckedThroughItsSquare) {
  EXPECT_DOUBLE_EQ(parse_toughness("0.5 MPa m^0.5"), 0.5e6);
  EXPECT_DOUBLE_EQ(parse_toughness("0.5 MPa sqrt(m)"), 0.5e6);
  EXPECT_DOUBLE_EQ(parse_toughness("0.5 MPa m^(1/2)"), 0.5e6);
  EXPECT_DOUBLE_EQ(parse_toughness("0.5 MPa*sqrt(m)"), 0.5e6);
  EXPECT_DOUBLE_EQ(parse_toughness("1 MPa sqrt(mm)"), 1e6 * std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(parse_toughness("16 N/mm^1.5"), 16 / std::pow(1e-3, 1.5));
  EXPECT_DOUBLE_EQ(parse_toughness("16 N mm^-1.5"), 16 / std::pow(1e-3, 1.5));
  EXPECT_DOUBLE_EQ(parse_toughness("2 N m^-2 m^(1/2)"), 2);
  for (const char* text : {"0.5 MPa", "0.5 MPa m", "0.5 MPa m^0.25", "0.5 MPa m^1/2", "0.5 MPa sqrt(s)", "0.5", "",
                           "1 sqrt(", "1 sqrt(m", "1 m^", "1 m^0.5x", "1 MPa m^0.55"})
    EXPECT_THROW(parse_toughness(text), Error) << text;
}
