#include "io/study/members.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "core/error.hpp"
#include "core/plan/plan.hpp"
#include "core/plan/predict_memory.hpp"
#include "io/child.hpp"
#include "io/overrides.hpp"
#include "io/read_scene.hpp"
#include "io/study/ladder.hpp"
#include "io/toml_text.hpp"

namespace riven::study {

namespace {

std::string hash_of(std::string_view bytes) {
  const XXH128_hash_t h = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", h.high64, h.low64);
}

/// Of this program: what another one found, or took for it, says nothing about this one.
std::string hash_of_program() {
  std::ifstream in(own_program(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return hash_of(bytes);
}

std::string hash_of(const Scene& s, const Study& study, const std::string& program) {
  std::string text = fmt::format("{}\n{}\n{}\n", program, study.threads, s.source_text);
  for (const auto& [name, content] : s.files)
    text.append(name).append("\n").append(content);
  return hash_of(text);
}

/// Does the choice only say how J is found?
bool reads(const Choice& c) {
  return !c.set.empty() && std::all_of(c.set.begin(), c.set.end(), [](const std::string& s) {
    return s.starts_with("fracture.") && !s.starts_with("fracture.reading");
  });
}

/// "fracture.contour=8" of a choice as the entry of fracture.reading called `name`.
std::string reading(const std::string& name, const Choice& c) {
  std::vector<std::string> keys{"name=" + name};
  for (const std::string& s : c.set)
    keys.push_back(s.substr(std::string("fracture.").size()));
  toml::table entry;
  apply_overrides(entry, keys);
  return toml_value(entry);
}

class Expander {
 public:
  Expander(const Study& study, const std::string& scene) : study_(study), scene_(scene) {
    const Scene plain = read_scene(scene, study.set);
    if (make_plan(plain).growth)
      return;
    for (size_t a = 0; a < study.axes.size() && !reading_axis_; ++a)
      if (std::all_of(study.axes[a].choices.begin(), study.axes[a].choices.end(), reads))
        reading_axis_ = a;
  }

  Members expand() {
    if (!study_.axes.empty())
      combine({});
    if (!study_.left_out.empty()) {
      out_.members.push_back({{}, run("as it is", {}), "", "nothing"});
      for (const LeftOut& l : study_.left_out)
        out_.members.push_back({{}, run("without " + l.name, l.set), "", l.name});
    }
    check();
    return std::move(out_);
  }

 private:
  void combine(std::vector<size_t> choice) {
    if (choice.size() == study_.axes.size()) {
      add(choice);
      return;
    }
    for (size_t c = 0; c < study_.axes[choice.size()].choices.size(); ++c) {
      choice.push_back(c);
      combine(choice);
      choice.pop_back();
    }
  }

  void add(const std::vector<size_t>& choice) {
    std::string label;
    std::vector<std::string> set;
    Member m{choice, 0, "", ""};
    for (size_t a = 0; a < choice.size(); ++a) {
      const Choice& c = study_.axes[a].choices[choice[a]];
      if (a == reading_axis_) {
        m.reading = reading_name(choice[a]);
        continue;
      }
      label += (label.empty() ? "" : ", ") + study_.axes[a].name + " " + c.label;
      set.insert(set.end(), c.set.begin(), c.set.end());
    }
    if (reading_axis_) {
      std::string list;
      const std::vector<Choice>& choices = study_.axes[*reading_axis_].choices;
      for (size_t c = 0; c < choices.size(); ++c)
        list += (c ? ", " : "") + reading(reading_name(c), choices[c]);
      set.push_back("fracture.reading=[" + list + "]");
    }
    m.run = run(label, set);
    out_.members.push_back(std::move(m));
  }

  static std::string reading_name(size_t choice) { return fmt::format("reading {}", choice + 1); }

  /// The run with these settings, made if there is none.
  size_t run(const std::string& label, const std::vector<std::string>& own) {
    std::vector<std::string> set = study_.set;
    set.insert(set.end(), own.begin(), own.end());
    const auto [known, fresh] = numbers_.try_emplace(set, out_.runs.size());
    if (!fresh)
      return known->second;
    Run r{label, set, "", 0, "", 0};
    try {
      const Scene s = read_scene(scene_, set);
      r.particles = predict_memory(s, make_plan(s)).particles;
      r.hash = hash_of(s, study_, program_);
      r.work = work_of(s);
      if (const auto same = scenes_.try_emplace(r.hash, known->second); !same.second)
        return known->second = same.first->second;
    } catch (const Error& e) {
      if (e.code() != Exit::bad_input)
        throw;
      r.refused = e.what();
      refusals_.emplace(out_.runs.size(), e.trouble());
    }
    out_.runs.push_back(std::move(r));
    return known->second;
  }

  /// A choice that no combination can be run with is a mistake in the study.
  void check() const {
    const auto refused = [&](const Member& m) { return !out_.runs[m.run].refused.empty(); };
    for (size_t a = 0; a < study_.axes.size(); ++a)
      for (size_t c = 0; c < study_.axes[a].choices.size(); ++c)
        if (std::all_of(out_.members.begin(), out_.members.end(),
                        [&](const Member& m) { return m.choice.empty() || m.choice[a] != c || refused(m); }))
          blame(fmt::format("{} = {}", study_.axes[a].name, study_.axes[a].choices[c].label),
                [&](const Member& m) { return !m.choice.empty() && m.choice[a] == c; });
    for (const Member& m : out_.members)
      if (m.choice.empty() && refused(m))
        blame("without " + m.left_out, [&](const Member& o) { return o.left_out == m.left_out && o.choice.empty(); });
  }

  /// Throws what the first of these members was refused for.
  template <class Is>
  void blame(const std::string& what, const Is& is) const {
    const auto m = std::find_if(out_.members.begin(), out_.members.end(), is);
    Trouble t = refusals_.at(m->run);
    t.where = study_.path + ": " + what + ": " + t.where;
    fail(std::move(t));
  }

  const Study& study_;
  const std::string scene_;
  const std::string program_ = hash_of_program();
  std::optional<size_t> reading_axis_;
  std::map<std::vector<std::string>, size_t> numbers_;  ///< of runs, by their settings
  std::map<std::string, size_t> scenes_;                ///< by their hash: settings may say what the scene does
  std::map<size_t, Trouble> refusals_;
  Members out_;
};

}  // namespace

Members expand(const Study& study, const std::string& scene) {
  return Expander(study, scene).expand();
}

std::string column_of(const Member& member, const std::string& column) {
  const size_t last = column.rfind(' ');
  if (member.reading.empty() || last == std::string::npos)
    return column;
  const std::string what = column.substr(last + 1);
  if (what != "J" && what != "K_I" && what != "K_II")
    return column;
  return column.substr(0, last + 1) + member.reading + column.substr(last);
}

}  // namespace riven::study
