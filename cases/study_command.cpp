#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "cases/commands.hpp"
#include "cases/shipped.hpp"
#include "cases/study_tables.hpp"
#include "core/error.hpp"
#include "io/at_place.hpp"
#include "io/child.hpp"
#include "io/folder_lock.hpp"
#include "io/study/read_study.hpp"
#include "io/study/run_members.hpp"
#include "io/study/settings_text.hpp"
#include "io/suggest.hpp"

namespace riven {

namespace fs = std::filesystem;

namespace {

struct StudyArguments {
  std::string study, folder, within, result;
  int threads = 0;
  bool untimed = false, quiet = false, list = false, dry = false;
};

void list_studies() {
  for (const std::string& name : shipped_names(Shipped::study))
    fmt::print("{:<16} {}\n", name, study::read_study(shipped_file(Shipped::study, name)->string()).title);
}

study::Study read(const StudyArguments& o) {
  study::Study s = study::read_study(find_file(Shipped::study, o.study));
  if (o.untimed)
    s.timing = false;
  if (o.threads > 0)
    s.threads = o.threads;
  return s;
}

/// The scene of a study: a file next to the study, or a shipped one.
std::string scene_of(const study::Study& s) {
  const fs::path beside = fs::path(s.path).parent_path() / s.scene;
  if (fs::is_regular_file(beside))
    return beside.string();
  return at_place(s.path + ": scene", [&] { return find_file(Shipped::scene, s.scene); });
}

size_t result_of(const study::Study& s, const std::string& name) {
  if (name.empty())
    return 0;
  std::vector<std::string> names;
  for (const study::Result& r : s.results)
    names.push_back(r.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return static_cast<size_t>(found - names.begin());
  const std::string near = nearest(name, names);
  fail({Exit::bad_input, "the study has no such result", "--result", shown(name), listed(names),
        near.empty() ? "" : "did you mean '" + near + "'?"});
}

void print_setting(const study::Study& s, const study::Members& members, const study::Assessment& a, size_t result,
                   double tolerance) {
  const std::vector<study::Point>& points = a.results[result].points;
  const std::optional<size_t> k = study::cheapest(a.results[result].settled, tolerance);
  if (!k)
    fail({Exit::bad_input, fmt::format("no setting of the study comes within {:.3g} %", 100 * tolerance), s.path,
          s.results[result].name, "", "a finer choice, or a larger tolerance"});
  const std::vector<std::string> set = study::keys_of(s, members, a.settings[*k]);
  std::vector<std::string> all = s.set;
  all.insert(all.end(), set.begin(), set.end());
  fmt::print("# {} within {:.3g} %: error {:.2g} %, {:.3g} s\n# {}\n{}", s.results[result].name, 100 * tolerance,
             100 * points[*k].error, points[*k].cost, study::as_command(s.scene, all), study::settings_as_toml(set));
}

void draw(const fs::path& folder) {
  Children children;
  const fs::path log = folder / "picture.txt";
  std::vector<std::string> command = shipped_script("riven_study.py");
  command.push_back(folder.string());
  children.start(command, log);
  const ChildEnd end = children.wait();
  if (end.code != 0 || end.signal != 0)
    fmt::print(stderr, "riven: the pictures could not be drawn, see {}\n", log.string());
  else
    fs::remove(log);
}

void run(const StudyArguments& o) {
  if (o.list) {
    list_studies();
    return;
  }
  const double tolerance = o.within.empty() ? 0 : parse_tolerance(o.within);
  const study::Study s = read(o);
  const size_t asked = result_of(s, o.result);
  const std::string scene = scene_of(s);
  const study::Members members = study::expand(s, scene);
  if (o.dry) {
    print_runs(s, members);
    return;
  }
  const fs::path folder = o.folder.empty() ? "results/" + s.name : o.folder;
  const FolderLock lock(folder);
  study::refuse_to_remove_study(folder, s);
  const study::Store store(folder);
  bool checked = false;
  const std::vector<study::Record> records = study::run_members(s, scene, members.runs, store, [&](const auto& a) {
    if (!o.quiet)
      print_advance(a);
    if (!checked && a.record->done()) {
      study::check_results(s, members, static_cast<size_t>(a.run - members.runs.data()), store);
      checked = true;
    }
  });
  const study::Assessment assessment = study::assess(s, members, records, store);
  study::write_study(store.folder(), s, members, records, assessment);
  draw(store.folder());
  if (tolerance > 0)
    print_setting(s, members, assessment, asked, tolerance);
  else if (!o.quiet)
    print_study(s, members, records, assessment);
}

}  // namespace

void add_study(CLI::App& app) {
  auto o = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand("study", "runs a scene over a grid of choices: what accuracy costs in time");
  command->add_option("study", o->study, "a study file, or the name of a shipped study");
  command->add_option("-o,--output", o->folder, "folder for the results; results/NAME unless said");
  command->add_option("--within", o->within, "print the cheapest setting for this error, as 2% or 0.02, as TOML");
  command->add_option("--result", o->result, "the result that --within is about; the first unless said");
  command->add_option("--threads", o->threads, "threads of each run")->check(CLI::Range(1, 1024));
  command->add_flag("--no-timing", o->untimed, "take no times: members run side by side, once");
  command->add_flag("--dry-run", o->dry, "list the runs that the study takes, and do none");
  command->add_flag("--list", o->list, "list the shipped studies");
  command->add_flag("--quiet", o->quiet, "print nothing but errors, and what --within asks for");
  command->callback([o, command] {
    if (o->study.empty() && !o->list)
      throw CLI::RequiredError("study");
    run(*o);
  });
}

}  // namespace riven
