// A study: one scene over a grid of choices, what is read from each run, and what that is held against.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace riven::study {

/// One way to set some keys of the scene.
struct Choice {
  std::string label;
  std::vector<std::string> set;                            ///< "key=value", as `riven run --set` takes them
  double size = std::numeric_limits<double>::quiet_NaN();  ///< Axis::refined: what tends to zero, in SI
};

struct Axis {
  std::string name;
  std::vector<Choice> choices;
  bool refined = false;  ///< errors and costs are fitted along this one
  bool problem = false;  ///< its choices are other problems, not other ways to solve one: a setting has to do for all
};

/// How a column of the history becomes one number, or is held against a curve.
enum class Take { end, mean, rms, largest, smallest, curve };

/// What a result should be.
struct Reference {
  enum class Kind { none, value, curve, extrapolated };
  Kind kind = Kind::none;
  std::string value;  ///< a quantity as written; its unit is checked once that of the column is known
  std::string file;   ///< of a curve: two columns, the time first, with units in the header
};

/// What a result of one problem should be, and in which part of the run.
struct Target {
  double from = 0, to = std::numeric_limits<double>::infinity();  ///< s
  Reference reference;
  /// A quantity that errors are divided by; empty: the reference, or the largest value of its curve.
  std::string scale;
  std::string where;  ///< in the study file, with the problem
};

/// A named result of each member.
struct Result {
  std::string name;
  std::string column;  ///< of history.csv, without its unit
  Take take = Take::end;
  std::vector<Target> targets;  ///< [choices of the axis of problems]; [1] where there is none
};

/// What leaving an effect out costs and saves: the scene as it is beside the scene with these settings.
struct LeftOut {
  std::string name;
  std::vector<std::string> set;
};

struct Study {
  std::string name;  ///< file name without its ending
  std::string title;
  std::string path;
  std::string scene;             ///< a file, relative to the study's folder, or the name of a shipped scene
  std::vector<std::string> set;  ///< of all members
  std::vector<Axis> axes;
  std::vector<Result> results;
  std::vector<LeftOut> left_out;
  bool timing = true;        ///< members run one at a time; else side by side on the free cores
  int repeats = 3;           ///< of runs shorter than
  double repeat_under = 20;  ///< s
  int threads = 0;           ///< of each run; 0: all cores where times are taken, else 1

  /// The axis along which errors are fitted.
  std::optional<size_t> refined() const { return first(&Axis::refined); }
  /// The axis of problems.
  std::optional<size_t> problem() const { return first(&Axis::problem); }
  size_t problems() const { return problem() ? axes[*problem()].choices.size() : 1; }

 private:
  std::optional<size_t> first(bool Axis::*kind) const {
    for (size_t a = 0; a < axes.size(); ++a)
      if (axes[a].*kind)
        return a;
    return std::nullopt;
  }
};

}  // namespace riven::study
