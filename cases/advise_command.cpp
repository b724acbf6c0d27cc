#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "cases/commands.hpp"
#include "cases/shipped.hpp"
#include "cases/study_tables.hpp"
#include "core/error.hpp"
#include "io/folder_lock.hpp"
#include "io/format_length.hpp"
#include "io/progress.hpp"
#include "io/read_scene.hpp"
#include "io/study/advise.hpp"
#include "io/study/numeric_table.hpp"
#include "io/study/settings_text.hpp"

namespace riven {

namespace {

struct AdviseArguments {
  std::string scene, folder, within;
  std::vector<std::string> set, results;
  int threads = 0;
  bool quiet = false;
};

/// The ladder as members of a study of the cell.
study::Study study_of(const AdviseArguments& o, const std::vector<study::Rung>& ladder) {
  study::Study s;
  s.path = o.scene;
  s.set = o.set;
  s.threads = o.threads;
  s.repeat_under = 2;  // the times of longer runs are good enough for a prediction
  study::Axis cells{"cell", {}, true};
  for (const study::Rung& r : ladder)
    cells.choices.push_back({format_length(r.cell, 4), r.set, r.cell});
  s.axes = {cells};
  return s;
}

void print_ladder(const std::vector<study::Rung>& ladder, const std::vector<study::Record>& records) {
  fmt::print("# {:>12} {:>12} {:>10} {:>10}\n", "cell", "particles", "steps", "time");
  for (size_t k = 0; k < ladder.size(); ++k)
    fmt::print("# {:>12} {:>12} {:>10} {:>10}\n", format_length(ladder[k].cell, 4), records[k].particles,
               records[k].steps, format_time(records[k].wall.front()));
}

void print_laws(const std::vector<study::ErrorLaw>& laws, double finest, const study::Advice& a) {
  fmt::print("#\n# {:<28} {:>7} {:>22} {:>12}\n", "expected error of", "order", "at the finest of these", "as advised");
  for (const study::ErrorLaw& law : laws)
    fmt::print("# {:<28} {:>7} {:>20.2g} % {:>10.2g} %\n", law.column,
               std::isfinite(law.measured) ? fmt::format("{:.1f}", law.measured) : "none", 100 * law.error(finest),
               100 * law.error(a.rung.cell));
}

void print_advice(const AdviseArguments& o, const study::Advice& a, double tolerance) {
  std::vector<std::string> all = o.set;
  all.insert(all.end(), a.rung.set.begin(), a.rung.set.end());
  fmt::print("#\n# {} {:.3g} %: expected error {:.2g} % ({}), predicted time {:.3g} s, {} of memory\n",
             a.reached ? "within" : "the finest cell that the scene allows does not come within", 100 * tolerance,
             100 * a.error, a.column, a.seconds, format_bytes(std::lround(a.memory)));
  fmt::print("# {}\n", a.sure ? "the three runs converge as they should: the estimate should hold"
                              : "the three runs do not converge as they should: not sure, see the orders above");
  fmt::print("# {}\n{}", study::as_command(o.scene, all), study::settings_as_toml(a.rung.set));
}

std::vector<study::Record> climb(const AdviseArguments& o, const std::string& file,
                                 const std::vector<study::Rung>& ladder, const study::Store& store,
                                 std::vector<std::string>& histories) {
  const study::Study s = study_of(o, ladder);
  const study::Members members = study::expand(s, file);
  std::vector<study::Record> records = study::run_members(s, file, members.runs, store, [&](const auto& a) {
    if (!o.quiet)
      print_advance(a);
  });
  for (size_t k = 0; k < records.size(); ++k) {
    if (!records[k].done())
      fail({records[k].status == "refused" ? Exit::bad_input : Exit::unstable, "a run of the ladder failed",
            members.runs[k].label, records[k].message, "", "see to that run first"});
    histories.push_back((store.results(members.runs[k]) / "history.csv").string());
  }
  return records;
}

void run(const AdviseArguments& o) {
  const double tolerance = parse_tolerance(o.within);
  const std::string file = find_file(Shipped::scene, o.scene);
  const Scene scene = read_scene(file, o.set);
  const std::vector<study::Rung> rungs = study::rungs(scene), ladder = study::choose_ladder(scene, rungs);
  const study::Store store(o.folder.empty() ? "results/" + scene.name + "_advice" : o.folder);
  const FolderLock lock(store.folder());
  std::vector<std::string> histories;
  const std::vector<study::Record> records = climb(o, file, ladder, store, histories);
  const std::vector<std::string> columns =
      o.results.empty()
          ? study::asked_columns(scene, study::read_numeric_table(histories.back(), "the history of a run").names)
          : o.results;
  const std::vector<study::ErrorLaw> laws = study::fit_errors(ladder, histories, columns);
  if (laws.empty())
    fail({Exit::bad_input, "no result of the scene changes from cell to cell", file, "", "probes, or J at tips",
          "--result COLUMN with a column of history.csv"});
  const study::Advice a = study::advise(rungs, ladder, records, laws, tolerance);
  print_ladder(ladder, records);
  print_laws(laws, ladder.back().cell, a);
  print_advice(o, a, tolerance);
}

}  // namespace

void add_advise(CLI::App& app) {
  auto o = std::make_shared<AdviseArguments>();
  CLI::App* command =
      app.add_subcommand("advise", "finds the cell with which a scene comes within a tolerance, by quick coarse runs");
  command->add_option("scene", o->scene, "a scene file, or the name of a shipped scene")->required();
  command->add_option("--within", o->within, "the tolerance, as 2% or 0.02")->required();
  command->add_option("--set", o->set, "change a key of the scene")->take_all();
  command
      ->add_option("--result", o->results, "a column of history.csv to go by; the scene's probes and tips unless said")
      ->take_all();
  command->add_option("--threads", o->threads, "threads of each run")->check(CLI::Range(1, 1024));
  command->add_option("-o,--output", o->folder, "folder for the runs; results/NAME_advice unless said");
  command->add_flag("--quiet", o->quiet, "print the advice alone");
  command->callback([o] { run(*o); });
}

}  // namespace riven
