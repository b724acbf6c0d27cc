// Which cell brings a scene without a reference within a tolerance, from a short ladder of coarse runs.
//
// What a run gives is its results over time. Of three runs with cells h1 > h2 > h3 the distances d12 and d23 between
// these, rms over the run's time and over the largest value, give the order p from d12/d23 = (h1^p - h2^p)/(h2^p -
// h3^p) and the error C h^p of any cell from C = d23/(h2^p - h3^p). A tolerance is asked of 1.25 times that error, the
// margin for estimates from three grids of P.J. Roache, "Verification and Validation in Computational Science and
// Engineering" (1998), section 5.6.
#pragma once
#include <string>
#include <vector>

#include "io/study/ladder.hpp"
#include "io/study/store.hpp"

namespace riven::study {

/// Three rungs that are coarse enough to be quick, the coarsest first. Throws Error (bad_input) when the scene has no
/// three cells to choose from.
std::vector<Rung> choose_ladder(const Scene& scene, const std::vector<Rung>& rungs);

/// Columns of the history that a scene asks for: its probes, else J, K_I and K_II of its tips, else its energies.
std::vector<std::string> asked_columns(const Scene& scene, const std::vector<std::string>& columns);

/// How the error of one result falls with the cell.
struct ErrorLaw {
  std::string column;
  double order = 1;
  double factor = 0;    ///< error = factor cell^order, of the largest value
  double measured = 0;  ///< order that the ladder shows; NaN where the distances do not shrink
  bool sure = false;    ///< the ladder shows an order that the scheme can have
  double error(double cell) const;
};

/// What the ladder's histories say of each column; columns that stay 0 but for rounding are left out. `histories`:
/// their files.
std::vector<ErrorLaw> fit_errors(const std::vector<Rung>& ladder, const std::vector<std::string>& histories,
                                 const std::vector<std::string>& columns);

/// What a run takes: seconds = steps (per_step + per_work particles), bytes = memory + per_particle particles.
struct CostLaw {
  double per_step = 0, per_work = 0;    ///< s
  double memory = 0, per_particle = 0;  ///< bytes
};
CostLaw fit_costs(const std::vector<Record>& records);

struct Advice {
  Rung rung;
  double error = 0;    ///< expected, of the result that is furthest off
  std::string column;  ///< that one
  bool sure = false;   ///< all laws that matter are
  bool reached = false;
  double seconds = 0, memory = 0;  ///< predicted
};

/// The largest cell with which all columns are within the tolerance or, where there is none, the smallest.
Advice advise(const std::vector<Rung>& rungs, const std::vector<Rung>& ladder, const std::vector<Record>& records,
              const std::vector<ErrorLaw>& laws, double tolerance);

}  // namespace riven::study
