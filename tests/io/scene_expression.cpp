#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "io/expression.hpp"

using namespace riven;

namespace {

std::string refusal(const std::string& text, const std::map<std::string, double>& times = {}) {
  try {
    parse_shape(text, times, 1e-3);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    return e.what();
  }
  return {};
}

}  // namespace

TEST(Expression, IsTheFunctionWritten) {
  const double tr = 0.204e-3;
  const auto ramp = parse_shape("t < tr ? sin(pi*t/tr) : 0", {{"tr", tr}}, 1e-3);
  for (const double t : {0.0, 0.3 * tr, 0.5 * tr, 0.99 * tr})
    EXPECT_NEAR(ramp(t), std::sin(std::numbers::pi * t / tr), 1e-15);
  EXPECT_EQ(ramp(2 * tr), 0);
  const auto pressure = parse_shape("0.5*(1 - cos(pi*min(t, tr)/tr))", {{"tr", tr}}, 1e-3);
  EXPECT_NEAR(pressure(tr / 2), 0.5, 1e-15);
  EXPECT_NEAR(pressure(1), 1, 1e-15);
  EXPECT_EQ(parse_shape("2^3 - -1", {}, 1)(0), 9);
  EXPECT_EQ(parse_shape("step(t - 0.5)", {}, 1)(0.25), 0);
  EXPECT_EQ(parse_shape("step(t - 0.5)", {}, 1)(0.5), 1);
  EXPECT_EQ(parse_shape("sign(t) + max(1, 2) + floor(1.5) + ceil(1.5)", {}, 1)(1), 6);
}

TEST(Expression, OfPlacesIsAFieldThatThreadsShare) {
  const PlaceShape f = parse_field("sin(pi*X/L)*Y + t", {{"L", 2}});
  const std::vector<double> X{0.5, 1, 1.5}, Y{1, 2, 3};
  std::vector<std::thread> threads;
  std::vector<int> wrong(4);
  for (size_t k = 0; k < wrong.size(); ++k)
    threads.emplace_back([&, k] {
      for (int round = 0; round < 1000; ++round) {
        double out[3];
        const double t = static_cast<double>(k) + round;
        f(t, 3, X.data(), Y.data(), out);
        for (size_t i = 0; i < 3; ++i)
          wrong[k] += std::abs(out[i] - (std::sin(std::numbers::pi * X[i] / 2) * Y[i] + t)) > 1e-12;
      }
    });
  for (std::thread& t : threads)
    t.join();
  for (const int w : wrong)
    EXPECT_EQ(w, 0);
}

TEST(Expression, NamesPlacesAsWordsOfTheirOwn) {
  for (const char* text : {"X", "2*Y", "sin(X)", "-X+t"})
    EXPECT_TRUE(names_place(text)) << text;
  for (const char* text : {"t", "Xa", "aX", "X_1", "maxY", "x", ""})
    EXPECT_FALSE(names_place(text)) << text;
}

TEST(Expression, CopiesAgree) {
  const auto f = parse_shape("t*t", {}, 1);
  const auto g = f;
  EXPECT_EQ(f(3), 9);
  EXPECT_EQ(g(2), 4);
  EXPECT_EQ(f(3), 9);
}

TEST(Expression, WhatCannotBeReadIsRefused) {
  for (const char* text :
       {"",      " ",  "(",     ")",     "1 +",      "sin",   "sin()", "sin(1,2)", "min(1)",   "1, 2",
        "t = 5", "tt", "\"a\"", "t; t",  "1 ? 2",    "1 : 2", "?:",    "rnd()",    "sum(1,2)", "t t",
        "1e",    "0x", "#",     "t == ", "((((((((", "-",     "&&",    "sin(t"})
    EXPECT_FALSE(refusal(text).empty()) << text;
  EXPECT_FALSE(refusal(std::string(100000, '(')).empty());
  EXPECT_NE(refusal("sni(t)").find("did you mean 'sin'"), std::string::npos);
  EXPECT_NE(refusal("sin(t/trr)", {{"tr", 1}}).find("did you mean 'tr'"), std::string::npos);
  for (const char* name : {"t", "pi", "sin", "", "2t", "a b"})
    EXPECT_FALSE(refusal("1", {{name, 1}}).empty()) << name;
}

TEST(Expression, IsFiniteFromStartToEnd) {
  EXPECT_NE(refusal("1/t").find("not finite at t = 0 s"), std::string::npos);
  EXPECT_NE(refusal("sqrt(0.0009 - t)").find("not finite at t ="), std::string::npos);
  EXPECT_NE(refusal("exp(1e6*t)").find("not finite"), std::string::npos);
  EXPECT_TRUE(std::isnan(parse_shape("sqrt(1 - t)", {}, 1)(2))) << "beyond the run: not a number, not an exception";
}
