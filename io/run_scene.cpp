#include "io/run_scene.hpp"

#include <fmt/format.h>

#include <array>
#include <future>
#include <optional>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/scene/names.hpp"
#include "core/scene/schedule.hpp"
#include "io/checkpoint_store.hpp"
#include "io/crack_paths.hpp"
#include "io/event_log.hpp"
#include "io/folder_lock.hpp"
#include "io/frames.hpp"
#include "io/progress.hpp"
#include "io/recorder.hpp"
#include "io/stop_request.hpp"
#include "io/summarize.hpp"
#include "io/what_helps.hpp"
#include "kernels/fragments.hpp"
#include "kernels/time_step.hpp"

namespace riven {

namespace {

/// Gives the simulation the state of the checkpoint, where there is one.
template <class Real>
RunSoFar take_up(SimulationOf<Real>& m, const RunOptions& options) {
  if (!options.restart)
    return {};
  RunSoFar so_far = options.restart->restore(m);
  if (m.finished())
    fail({Exit::bad_input, "the run has come further than this already", options.restart->path().string(),
          "solver.time = " + format_time(m.scene.end_time), "more than " + format_time(m.state.clock.time)});
  bring_frames(options.restart->path().parent_path(), options.folder, static_cast<int>(so_far.frames.size()));
  return so_far;
}

/// A scene on its way into a folder. Members are made in their order: nothing in the folder is touched before the lock,
/// and probes find their particles before those have moved.
template <class Real>
class Run {
 public:
  Run(SimulationOf<Real>& m, const RunOptions& options)
      : m_(m),
        options_(options),
        lock_(options.folder),
        probes_(m),
        so_far_(take_up(m, options)),
        checkpoints_(options.folder, m.scene.output, options.restart),
        stop_(options.wall_limit) {
    for (std::size_t k = 0; k < said_.size(); ++k)
      said_[k] = m.state.monitors[k].beyond > 0;
    open_results();
  }

  Summary all() {
    while (const std::optional<Error> trouble = go_on()) {
      if (so_far_.retries.size() >= static_cast<std::size_t>(m_.scene.limits.retries)) {
        write_frame();
        close("unstable", trouble->what());
        throw *trouble;
      }
      go_back(*trouble);
    }
    write_frame();
    return close("done", "");
  }

 private:
  /// Opens the files of results with what the run has so far; what is in them beyond that is taken away.
  void open_results() {
    record_.emplace(options_.folder, m_, probes_, so_far_.history);
    for (const char* of_the_end : {"crack_paths.csv", "summary.json"})  // one that is killed leaves none
      std::filesystem::remove(options_.folder / of_the_end);
    frames_.emplace(options_.folder, m_.scene, so_far_.frames);
    so_far_.history.clear();  // is in the file, and may be large
    if (m_.plan.growth || m_.plan.contact_waits || m_.scene.limits.retries > 0)
      events_.emplace(options_.folder / "events.csv", m_.state.events, m_.state.cracks);
    const Output& o = m_.scene.output;
    const double interval = o.frames > 0 ? m_.scene.end_time / o.frames : m_.scene.end_time;
    if (interval != so_far_.frame_interval)
      so_far_.frames_due = frames_reached(interval);
    so_far_.frame_interval = interval;
    progress_.emplace(m_.state.clock.time, m_.scene.end_time, m_.state.particles.count(), options_.quiet);
  }

  /// To the end of the run, or until a step goes wrong: why it is unstable.
  std::optional<Error> go_on() {
    try {
      if (frames_->times().empty()) {
        write_frame();
        record_->row();
      }
      while (!m_.finished())
        step();
      if (m_.plan.growth)
        fragments_ = find_fragments(m_);
    } catch (const Error& e) {
      progress_->finish();
      if (e.code() != Exit::unstable)
        throw;
      Trouble trouble = e.trouble();
      trouble.suggestion = what_helps(trouble.suggestion, m_.scene);
      return Error(std::move(trouble));
    }
    progress_->finish();
    return {};
  }

  /// The state of the newest checkpoint, or else that in which the run began.
  RunSoFar last_good() {
    m_.begin();
    if (checkpoints_.has_newest())
      return find_checkpoint(options_.folder).restore(m_);
    return options_.restart ? options_.restart->restore(m_) : RunSoFar{};
  }

  /// Takes up the last good state with smaller time steps. A checkpoint says so before any result is taken back:
  /// however the run ends, what goes on from it goes on with these.
  void go_back(const Error& e) {
    finish_frame();
    const Clock failed = m_.state.clock;
    RunSoFar back = last_good();
    Clock& clock = m_.state.clock;
    reduce_time_step(m_.scene.limits.retry_cfl, clock);
    so_far_.retries.push_back({failed.step, failed.time, clock.step, m_.scene.cfl * clock.dt_factor, e.what()});
    m_.state.events.push_back({.kind = CrackEvent::Kind::retry,
                               .step = failed.step,
                               .time = failed.time,
                               .crack = -1,
                               .place = e.trouble().place.value_or(Vec2{})});
    const Retry& r = so_far_.retries.back();
    fmt::print(stderr, "riven: warning: {}: {}\n  instead: back to step {}, CFL number {:.4g}; retry {} of {}\n",
               e.trouble().where, e.trouble().what, r.back_to, r.cfl, so_far_.retries.size(), m_.scene.limits.retries);
    back.wall_seconds = so_far_.wall_seconds;  // the time that was lost counts
    back.retries = std::move(so_far_.retries);
    so_far_ = std::move(back);
    RunSoFar stored = so_far_;
    stored.wall_seconds = wall_seconds();
    timed(checkpoints, [&] { checkpoints_.write(m_, stored); });
    open_results();
  }

  void step() {
    const Clock& clock = m_.state.clock;
    const double before = clock.time;
    m_.step();
    if (events_)
      events_->write(m_.state.events, m_.state.cracks);
    progress_->update(clock.step, clock.time, clock.dt, clock.limiter);
    bool warned = false;
    if (report_due(m_.scene, before, clock.time)) {
      timed(monitors, [&] { m_.take_stock(); });
      timed(history, [&] { record_->row(); });
      warned = warn();
    }
    if (m_.finished())
      return;
    if (reached() >= static_cast<double>(so_far_.frames_due) * so_far_.frame_interval) {
      write_frame();
      so_far_.frames_due = frames_reached(so_far_.frame_interval);
    }
    const bool stop = stop_.asked();
    if (!stop && !warned && !checkpoints_.due(clock.step))
      return;
    if (m_.scene.limits.retries > 0)
      require_good();
    if (stop)
      interrupt();
    write_checkpoint();
  }

  /// Says which figures are beyond their warning limits for the first time. A run that is suspect is kept as it is
  /// then: it may be the last good state.
  bool warn() {
    bool any = false;
    for (const auto& [which, name] : Names<Watched>::table) {
      const Monitor& w = monitor(m_.state.monitors, which);
      bool& said = said_[static_cast<std::size_t>(which)];
      const bool news = w.beyond > 0 && !said;
      said = w.beyond > 0;
      if (!news)
        continue;
      any = true;
      const WatchedText& text = text_of(which);
      fmt::print(stderr, "riven: warning: step {}, at ({:.4g}, {:.4g}) m: {}: {:.3g}{}{}\n", w.first, w.first_place.x,
                 w.first_place.y, text.what, w.value, *text.unit ? " " : "", text.unit);
      fmt::print(stderr, "  limit: {:.3g} (limits.warn.{})\n  try:   {}\n",
                 m_.scene.limits.warn[static_cast<size_t>(which)], name, what_helps(text.advice, m_.scene));
    }
    return any && m_.scene.output.checkpoint_every > 0;
  }

  /// Throws Error (unstable) when this is no state to go back to. Leaves it as it is.
  void require_good() {
    const Ledger ledger = m_.state.ledger;
    const Monitors figures = m_.state.monitors;
    timed(monitors, [&] { m_.take_stock(); });
    m_.state.ledger = ledger;
    m_.state.monitors = figures;
  }

  double reached() const { return m_.state.clock.time * (1 + 1e-12); }
  long frames_reached(double interval) const { return static_cast<long>(reached() / interval) + 1; }
  double wall_seconds() const { return so_far_.wall_seconds + exec::Stopwatch::now() - start_; }

  template <class F>
  void timed(size_t which, const F& work) {
    const double start = exec::Stopwatch::now();
    work();
    between_[which].seconds += exec::Stopwatch::now() - start;
    ++between_[which].calls;
  }

  /// A device computes on while the host, which has little else to do, writes a copy.
  void write_frame() {
    timed(frames, [&] {
      finish_frame();
      lock_.require_held();
      const double time = m_.state.clock.time;
      if (!m_.space.on_device())
        return frames_->write(time, m_.state.particles, m_.state.cracks);
      writing_ = std::async(std::launch::async, [this, time, particles = m_.state.particles, cracks = m_.state.cracks] {
        frames_->write(time, particles, cracks);
      });
    });
  }
  /// Before anything else is written or read back. Throws what went wrong with the frame.
  void finish_frame() {
    if (writing_.valid())
      writing_.get();
  }

  void write_checkpoint() {
    timed(checkpoints, [&] {
      finish_frame();
      lock_.require_held();
      checkpoints_.write(m_, {wall_seconds(), frames_->times(), so_far_.frame_interval, so_far_.frames_due,
                              record_->rows(), so_far_.retries});
    });
  }

  /// The last frame is none of the checkpoint's: it is not one that a run without interruption has.
  [[noreturn]] void interrupt() {
    const std::string folder = options_.folder.string(), by = stop_.by();
    write_checkpoint();
    progress_->finish();
    finish_frame();
    if (frames_->times().back() < m_.state.clock.time)
      write_frame();
    close("interrupted", "interrupted by " + by);
    fail({Exit::interrupted, "the run was interrupted by " + by, folder,
          fmt::format("{} of {}, step {}", format_time(m_.state.clock.time), format_time(m_.scene.end_time),
                      m_.state.clock.step),
          "", "riven run --restart " + folder});
  }

  Summary close(const char* status, const std::string& message) {
    finish_frame();
    lock_.require_held();
    frames_->finish();
    if (events_)
      events_->write(m_.state.events, m_.state.cracks);
    Summary s = summarize(m_, wall_seconds());
    s.status = status;
    s.message = message;
    s.probes = record_->probes();
    s.retries = so_far_.retries;
    s.between_steps = between_;
    s.fragments = fragments_;
    if (m_.plan.cracks)
      write_crack_paths(options_.folder / "crack_paths.csv", m_.state.cracks);
    write_summary(options_.folder / "summary.json", s);
    return s;
  }

  SimulationOf<Real>& m_;
  const RunOptions& options_;
  const FolderLock lock_;
  const Probes probes_;
  RunSoFar so_far_;
  CheckpointStore checkpoints_;
  std::optional<FrameWriter> frames_;
  std::future<void> writing_;  ///< a frame
  std::optional<Recorder<Real>> record_;
  std::optional<EventLog> events_;
  std::optional<Progress> progress_;
  StopRequest stop_;
  std::array<bool, watched_figures> said_{};  ///< which figures have been beyond their warning limits
  std::vector<Fragment> fragments_;           ///< at the end of the run
  double start_ = exec::Stopwatch::now();
  enum : size_t { monitors, history, frames, checkpoints };
  std::vector<Summary::Task> between_{
      {"energy and momentum", "", 0, 0}, {"history", "", 0, 0}, {"frames", "", 0, 0}, {"checkpoints", "", 0, 0}};
};

}  // namespace

template <class Real>
Summary run_scene(SimulationOf<Real>& m, const RunOptions& options) {
  return Run<Real>(m, options).all();
}

#define RIVEN_RUN_SCENE(Real) template Summary run_scene(SimulationOf<Real>&, const RunOptions&);
RIVEN_EACH_REAL(RIVEN_RUN_SCENE)
#undef RIVEN_RUN_SCENE

}  // namespace riven
