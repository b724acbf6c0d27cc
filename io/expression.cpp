#include "io/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <regex>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace {

constexpr size_t longest_shape = 1000;
constexpr int samples = 200;

using Unary = double (*)(double);
using Binary = double (*)(double, double);

// Fixed numbers of arguments only, and nothing random: a shape is the same function whenever it is called.
const std::vector<std::pair<std::string, Unary>>& unary_functions() {
  static const std::vector<std::pair<std::string, Unary>> table{
      {"sin", [](double x) { return std::sin(x); }},
      {"cos", [](double x) { return std::cos(x); }},
      {"tan", [](double x) { return std::tan(x); }},
      {"asin", [](double x) { return std::asin(x); }},
      {"acos", [](double x) { return std::acos(x); }},
      {"atan", [](double x) { return std::atan(x); }},
      {"sinh", [](double x) { return std::sinh(x); }},
      {"cosh", [](double x) { return std::cosh(x); }},
      {"tanh", [](double x) { return std::tanh(x); }},
      {"exp", [](double x) { return std::exp(x); }},
      {"ln", [](double x) { return std::log(x); }},
      {"log10", [](double x) { return std::log10(x); }},
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"abs", [](double x) { return std::abs(x); }},
      {"sign", [](double x) { return x > 0   ? 1.0
                                     : x < 0 ? -1.0
                                             : 0.0; }},
      {"floor", [](double x) { return std::floor(x); }},
      {"ceil", [](double x) { return std::ceil(x); }},
      {"step", [](double x) { return x < 0 ? 0.0 : 1.0; }}};
  return table;
}

const std::vector<std::pair<std::string, Binary>>& binary_functions() {
  static const std::vector<std::pair<std::string, Binary>> table{
      {"min", [](double a, double b) { return std::min(a, b); }},
      {"max", [](double a, double b) { return std::max(a, b); }},
      {"atan2", [](double a, double b) { return std::atan2(a, b); }}};
  return table;
}

/// A parser with its variables bound to places of its own; not to be copied or moved, muParser keeps the addresses.
class Shape {
 public:
  Shape(const std::string& text, const Constants& constants, bool of_places) {
    parser_.ClearFun();
    parser_.ClearConst();
    for (const auto& [name, f] : unary_functions())
      parser_.DefineFun(name, f);
    for (const auto& [name, f] : binary_functions())
      parser_.DefineFun(name, f);
    parser_.DefineConst("pi", std::numbers::pi);
    for (const auto& [name, value] : constants)
      parser_.DefineConst(name, value);
    parser_.DefineVar("t", &t_);
    if (of_places) {
      parser_.DefineVar("X", &X_);
      parser_.DefineVar("Y", &Y_);
    }
    parser_.SetExpr(text);
  }
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  /// Value at t; throws mu::ParserError when the text has no single value.
  double at(double t) {
    t_ = t;
    int values = 0;
    const double* last = parser_.Eval(values);
    if (values != 1)
      throw mu::ParserError("one value expected, found a list");
    return last[0];
  }
  double at(double t, double X, double Y) {
    X_ = X;
    Y_ = Y;
    return at(t);
  }

 private:
  mu::Parser parser_;
  double t_ = 0, X_ = 0, Y_ = 0;
};

/// As many parsers of one text as there are threads that want one at a time.
class Pool {
 public:
  Pool(std::string text, Constants constants) : text_(std::move(text)), constants_(std::move(constants)) {}

  std::unique_ptr<Shape> take() {
    {
      const std::lock_guard lock(guard_);
      if (!free_.empty()) {
        std::unique_ptr<Shape> one = std::move(free_.back());
        free_.pop_back();
        return one;
      }
    }
    return std::make_unique<Shape>(text_, constants_, true);
  }
  void give(std::unique_ptr<Shape> one) {
    const std::lock_guard lock(guard_);
    free_.push_back(std::move(one));
  }

 private:
  const std::string text_;
  const Constants constants_;
  std::mutex guard_;
  std::vector<std::unique_ptr<Shape>> free_;
};

std::vector<std::string> names(const Constants& constants, bool of_places) {
  std::vector<std::string> all{"t", "pi"};
  if (of_places)
    all.insert(all.end(), {"X", "Y"});
  for (const auto& [name, f] : unary_functions())
    all.push_back(name);
  for (const auto& [name, f] : binary_functions())
    all.push_back(name);
  for (const auto& [name, value] : constants)
    all.push_back(name);
  return all;
}

[[noreturn]] void refuse(std::string what, std::string_view text, std::string limit, std::string hint = {}) {
  fail({Exit::bad_input, std::move(what), "", "\"" + shown(text) + "\"", std::move(limit), std::move(hint)});
}

void check_characters(const std::string& text) {
  if (text.size() > longest_shape)
    refuse("the expression is too long", text, fmt::format("{} characters", longest_shape));
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!std::isalnum(static_cast<unsigned char>(c)) &&
        std::string_view(" _.,+-*/^()<>=!&|?:").find(c) == std::string_view::npos)
      refuse("the expression has a character that it cannot have", text, "+ - * / ^ ( ) < > <= >= == != && || ? :");
    if (c != '=')
      continue;
    const bool compares = (i > 0 && std::string_view("<>=!").find(text[i - 1]) != std::string_view::npos) ||
                          (i + 1 < text.size() && text[i + 1] == '=');
    if (!compares)
      refuse("an expression cannot assign", text, "comparisons: == != <= >=", "'==' instead of '='");
  }
}

/// The number that ends where the word at `pos` begins, blanks left out; empty if something else stands there.
std::string number_before(const std::string& text, size_t pos) {
  static const std::regex number(R"((?:^|[^\w.])((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?) *$)");
  std::smatch found;
  const std::string before = text.substr(0, pos);
  return std::regex_search(before, found, number) ? found[1].str() : "";
}

/// What to do about a word that is no name.
std::string advice_on(const std::string& word, size_t pos, const std::string& text, const Constants& constants,
                      bool of_places) {
  if (const std::string number = number_before(text, pos); !number.empty())
    return fmt::format("a quantity is a constant that stands beside the expression: t1 = \"{} {}\", and t1 in it",
                       number, shown(word));
  if (word == "if")
    return "condition ? this : that";
  const std::string near = nearest(word, names(constants, of_places));
  return (near.empty() || near == word ? "" : "did you mean '" + near + "'? ") +
         "A constant of its own stands beside the expression: " + shown(word) + " = \"1 ms\"";
}

[[noreturn]] void unreadable(const mu::ParserError& e, const std::string& text, const Constants& constants,
                             bool of_places) {
  refuse("the expression cannot be read: " + shown(e.GetMsg()), text,
         "the named constants, " + listed(names({}, of_places)),
         e.GetCode() == mu::ecUNASSIGNABLE_TOKEN
             ? advice_on(e.GetToken(), static_cast<size_t>(std::max(0, static_cast<int>(e.GetPos()))), text, constants,
                         of_places)
             : "");
}

void check(const std::string& text, const Constants& constants) {
  check_characters(text);
  for (const auto& [name, value] : constants)
    check_constant_name(name);
}

}  // namespace

void check_constant_name(const std::string& word) {
  constexpr size_t longest = 32;
  const std::vector<std::string> taken = names({}, true);
  const bool plain =
      !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) &&
      std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (!plain || word.size() > longest || std::find(taken.begin(), taken.end(), word) != taken.end())
    refuse("this cannot be the name of a constant", word,
           "letters, digits and _, and neither the name of a function nor t, X, Y, pi");
}

bool names_place(const std::string& text) {
  const auto part_of_word = [&](size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (size_t i = 0; i < text.size(); ++i)
    if ((text[i] == 'X' || text[i] == 'Y') && !part_of_word(i + 1) && (i == 0 || !part_of_word(i - 1)))
      return true;
  return false;
}

std::function<double(double)> parse_shape(const std::string& text, const Constants& constants, double end) {
  check(text, constants);
  try {
    const auto shape = std::make_shared<Shape>(text, constants, false);
    for (int i = 0; i <= samples; ++i) {
      const double t = end * i / samples, value = shape->at(t);
      if (!std::isfinite(value))
        refuse(fmt::format("the expression is not finite at t = {:.6g} s", t), text,
               fmt::format("finite values from t = 0 to the end, {:.6g} s", end));
    }
    return [shape](double t) {
      try {
        return shape->at(t);
      } catch (const mu::ParserError&) {
        return std::numeric_limits<double>::quiet_NaN();
      }
    };
  } catch (const mu::ParserError& e) {
    unreadable(e, text, constants, false);
  }
}

PlaceShape parse_field(const std::string& text, const Constants& constants) {
  check(text, constants);
  const auto pool = std::make_shared<Pool>(text, constants);
  try {
    std::unique_ptr<Shape> first = pool->take();
    first->at(0, 0, 0);
    pool->give(std::move(first));
  } catch (const mu::ParserError& e) {
    unreadable(e, text, constants, true);
  }
  return [pool](double t, long n, const double* X, const double* Y, double* out) {
    std::unique_ptr<Shape> shape = pool->take();
    try {
      for (long i = 0; i < n; ++i)
        out[i] = shape->at(t, X[i], Y[i]);
    } catch (const mu::ParserError&) {
      std::fill(out, out + n, std::numeric_limits<double>::quiet_NaN());
    }
    pool->give(std::move(shape));
  };
}

}  // namespace riven
