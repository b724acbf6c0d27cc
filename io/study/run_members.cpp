#include "io/study/run_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.hpp"
#include "core/exec/space.hpp"
#include "io/atomic_file.hpp"
#include "io/checkpoint_store.hpp"
#include "io/child.hpp"
#include "io/stop_request.hpp"
#include "io/text_file.hpp"

namespace riven::study {

namespace fs = std::filesystem;

namespace {

/// What the run says of itself.
void read_summary(const fs::path& folder, Record& r) {
  std::ifstream in(folder / "summary.json");
  const auto j = nlohmann::json::parse(in, nullptr, false);
  if (!j.is_object())
    return;
  r.steps = j.value("steps", 0L);
  r.particles = j.value("particles", 0L);
  std::map<std::string, double> seconds;
  double total = 0;
  for (const auto& task : j.value("tasks", nlohmann::json::array())) {
    const double t = task.value("seconds", 0.0);
    seconds[task.value("effect", "")] += t;
    total += t;
  }
  for (const auto& [effect, t] : seconds)
    r.shares.emplace_back(effect, t / total);
}

Record record_of(const ChildEnd& end, const fs::path& folder, const fs::path& log) {
  Record r;
  r.message = read_text_file(log.string(), "what a run said");
  switch (static_cast<Exit>(end.code)) {
    case Exit::done: r.status = "done"; break;
    case Exit::unstable: r.status = "unstable"; break;
    case Exit::bad_input: r.status = "refused"; break;
    case Exit::interrupted: r.status = "interrupted"; break;
    default: r.status = "crashed";
  }
  if (end.signal != 0) {
    r.status = "crashed";
    r.message = fmt::format("killed by signal {}\n{}", end.signal, r.message);
  }
  read_summary(folder, r);
  r.memory = end.memory;
  r.wall = {end.wall};
  r.cpu = {end.cpu};
  return r;
}

class Runner {
 public:
  Runner(const Study& study, const std::string& scene, const std::vector<Run>& runs, const Store& store,
         const std::function<void(const Advance&)>& report)
      : study_(study),
        scene_(scene),
        runs_(runs),
        store_(store),
        report_(report),
        records_(runs.size()),
        cut_short_(runs.size()) {
    const int cores = exec::available_threads();
    threads_ = study.threads > 0 ? study.threads : study.timing ? cores : 1;
    abreast_ = study.timing ? 1 : static_cast<size_t>(std::max(1, cores / threads_));
    order_.resize(runs.size());
    std::iota(order_.begin(), order_.end(), size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](size_t a, size_t b) { return runs_[a].work < runs_[b].work; });
  }

  std::vector<Record> run() {
    for (size_t r = 0; r < runs_.size(); ++r)
      recall(r);
    for (round_ = 0; round_ < (study_.timing ? study_.repeats : 1); ++round_) {
      for (const size_t r : order_) {
        if (!due(r))
          continue;
        while (children_.running() >= abreast_)
          end_one();
        if (stop_.asked())
          break;
        begin(r);
      }
      while (children_.running() > 0)
        end_one();
      if (stop_.asked())
        fail({Exit::interrupted,
              fmt::format("interrupted by {}: {} of {} runs are done, and kept", stop_.by(), done(), runs_.size()), "",
              "", "", "the same command once more, which goes on"});
    }
    return std::move(records_);
  }

 private:
  /// What is known of a run from before.
  void recall(size_t r) {
    if (!runs_[r].refused.empty()) {
      records_[r].status = "refused";
      records_[r].message = runs_[r].refused;
    } else if (std::optional<Record> kept = store_.find(runs_[r]); kept && !(kept->done() && lost(r))) {
      (kept->cut_short() ? cut_short_[r] : records_[r]) = std::move(*kept);
    }
  }

  /// Is what the results are taken from no longer there?
  bool lost(size_t r) const {
    std::error_code error;
    return fs::file_size(store_.results(runs_[r]) / "history.csv", error) == 0 || error;
  }

  /// Is the run to be done in this round?
  bool due(size_t r) const {
    const Record& k = records_[r];
    if (!runs_[r].refused.empty() || static_cast<int>(k.wall.size()) > round_)
      return false;
    return round_ == 0 || (k.done() && k.wall.front() < study_.repeat_under);
  }

  fs::path folder(size_t r) const {
    const fs::path results = store_.results(runs_[r]);
    return round_ == 0 ? results : results / "again";
  }

  /// Is there a checkpoint from which a run that was cut short can go on? A run that is timed has to say for how long
  /// it ran before: a killed one does not.
  bool goes_on(size_t r) const {
    const Record& before = cut_short_[r];
    if (round_ > 0 || before.status == "crashed" || (study_.timing && before.wall.empty()))
      return false;
    try {
      find_checkpoint(folder(r));
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  void begin(size_t r) {
    const fs::path to = folder(r);
    make_folder(to);
    std::vector<std::string> command{own_program().string(), "run", scene_, "-o", to.string(), "--quiet"};
    if (goes_on(r)) {
      command.insert(command.end(), {"--restart", to.string()});
    } else {
      command.emplace_back("--overwrite");
      cut_short_[r] = {};
    }
    command.insert(command.end(), {"--threads", std::to_string(threads_)});
    for (const std::string& s : runs_[r].set)
      command.insert(command.end(), {"--set", s});
    under_way_[children_.start(command, to / "messages.txt")] = r;
  }

  void end_one() {
    const ChildEnd end = children_.wait([&] {
      if (stop_.asked())
        children_.signal(SIGTERM);  // for those that the signal did not reach
    });
    const size_t r = under_way_.at(end.child);
    under_way_.erase(end.child);
    const fs::path from = folder(r);
    Record fresh = record_of(end, from, from / "messages.txt");
    if (end.code == static_cast<int>(Exit::file))
      fail({Exit::file, "a run of the study could not write its results", from.string(), "", "",
            "see to that, and start the study again: what is done is kept\n" + fresh.message});
    if (round_ == 0) {
      for (const double wall : cut_short_[r].wall)
        fresh.wall.front() += wall;
      for (const double cpu : cut_short_[r].cpu)
        fresh.cpu.front() += cpu;
      records_[r] = std::move(fresh);
    } else if (!fresh.done()) {
      fs::remove_all(from);
      return;
    } else {
      records_[r].wall.push_back(end.wall);
      records_[r].cpu.push_back(end.cpu);
      fs::remove_all(from);
    }
    store_.keep(runs_[r], records_[r]);
    report(r);
  }

  size_t done() const {
    return static_cast<size_t>(std::count_if(records_.begin(), records_.end(),
                                             [](const Record& r) { return !r.wall.empty() && !r.cut_short(); }));
  }

  void report(size_t r) const {
    Advance a{&runs_[r], &records_[r]};
    double seconds = 0, work = 0, rest = 0;
    for (size_t k = 0; k < runs_.size(); ++k)
      if (!records_[k].wall.empty()) {
        seconds += records_[k].wall.front();
        work += runs_[k].work;
      }
    const double per_work = work > 0 ? seconds / work : 0;
    for (size_t k = 0; k < runs_.size(); ++k) {
      if (!runs_[k].refused.empty())
        continue;
      const Record& q = records_[k];
      const double expected = q.wall.empty() ? per_work * runs_[k].work : q.wall.front();
      const bool ended_early = !q.wall.empty() && !q.done();
      const bool again = study_.timing && expected < study_.repeat_under && !ended_early;
      const size_t wanted = again ? static_cast<size_t>(study_.repeats) : 1;
      const size_t had = std::min(wanted, q.wall.size());
      a.done += had;
      a.all += wanted;
      rest += static_cast<double>(wanted - had) * expected;
    }
    a.seconds_left = rest / static_cast<double>(abreast_);
    report_(a);
  }

  const Study& study_;
  const std::string scene_;
  const std::vector<Run>& runs_;
  const Store& store_;
  const std::function<void(const Advance&)>& report_;
  std::vector<Record> records_, cut_short_;  ///< of the runs; of those that a study before had begun
  std::vector<size_t> order_;                ///< of the runs, by their work
  StopRequest stop_{std::numeric_limits<double>::infinity(), StopRequest::Waits::end};
  Children children_;
  std::map<pid_t, size_t> under_way_;
  int threads_ = 1;
  size_t abreast_ = 1;
  int round_ = 0;
};

}  // namespace

std::vector<Record> run_members(const Study& study, const std::string& scene, const std::vector<Run>& runs,
                                const Store& store, const std::function<void(const Advance&)>& report) {
  return Runner(study, scene, runs, store, report).run();
}

}  // namespace riven::study
