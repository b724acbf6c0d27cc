#include "io/study/write_study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/math/median.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "io/suggest.hpp"

namespace riven::study {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* json_name = "study.json";

Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

double middle(const std::vector<double>& times) {
  return times.empty() ? std::numeric_limits<double>::quiet_NaN() : median(times);
}

/// The writing of one study.
class Writer {
 public:
  Writer(const Study& study, const Members& members, const std::vector<Record>& records, const Assessment& assessment)
      : study_(study), members_(members), records_(records), assessment_(assessment) {}

  std::string csv() const {
    std::string text = "member";
    for (const Axis& a : study_.axes)
      text += "," + csv_field(a.name);
    text += ",left out,status,wall [s],wall least [s],wall greatest [s],cpu [s],memory [B],particles,steps,repeats";
    for (size_t r = 0; r < study_.results.size(); ++r)
      text += "," + csv_field(fmt::format("{} [{}]", study_.results[r].name, unit(r))) + "," +
              csv_field(study_.results[r].name + " error [1]");
    text += "\n";
    for (size_t k = 0; k < members_.members.size(); ++k)
      text += row(k);
    return text;
  }

  Json json() const {
    Json j;
    j["study"] = study_.name;
    j["title"] = study_.title;
    j["scene"] = study_.scene;
    j["version"] = RIVEN_VERSION;
    j["timed"] = study_.timing;
    j["axes"] = axes();
    j["members"] = Json::array();
    for (size_t k = 0; k < members_.members.size(); ++k)
      j["members"].push_back(member(k));
    j["settings"] = Json::array();
    for (const Setting& s : assessment_.settings)
      j["settings"].push_back({{"label", s.label}, {"members", s.members}});
    j["methods"] = Json::array();
    for (const Method& m : assessment_.methods)
      j["methods"].push_back(
          {{"label", m.label}, {"settings", m.settings}, {"stands", m.stands ? Json(*m.stands) : Json(nullptr)}});
    j["results"] = Json::array();
    for (size_t r = 0; r < study_.results.size(); ++r)
      j["results"].push_back(result(r));
    j["left_out"] = left_out();
    return j;
  }

 private:
  const Record& record(size_t member) const { return records_[members_.members[member].run]; }

  std::string unit(size_t result) const {
    for (const Taken& t : assessment_.results[result].taken)
      if (!t.unit.empty())
        return t.unit;
    return "1";
  }

  std::string row(size_t k) const {
    const Member& m = members_.members[k];
    const Record& q = record(k);
    std::string text = csv_field(assessment_.labels[k]);
    for (size_t a = 0; a < study_.axes.size(); ++a)
      text += "," + (m.choice.empty() ? "" : csv_field(study_.axes[a].choices[m.choice[a]].label));
    const auto extreme = [&](auto pick) { return q.wall.empty() ? middle({}) : *pick(q.wall.begin(), q.wall.end()); };
    text += fmt::format(",{},{},{},{},{},{},{},{},{},{}", csv_field(m.left_out), q.status, middle(q.wall),
                        extreme([](auto a, auto b) { return std::min_element(a, b); }),
                        extreme([](auto a, auto b) { return std::max_element(a, b); }), middle(q.cpu), q.memory,
                        q.particles, q.steps, q.wall.size());
    for (const ResultReport& r : assessment_.results)
      text += fmt::format(",{},{}", r.taken[k].value, r.taken[k].error);
    return text + "\n";
  }

  Json axes() const {
    Json list = Json::array();
    for (const Axis& a : study_.axes) {
      Json choices = Json::array();
      for (const Choice& c : a.choices)
        choices.push_back({{"label", c.label}, {"set", c.set}, {"size", number(c.size)}});
      list.push_back({{"name", a.name}, {"refined", a.refined}, {"problem", a.problem}, {"choices", choices}});
    }
    return list;
  }

  Json member(size_t k) const {
    const Member& m = members_.members[k];
    const Record& q = record(k);
    Json j{{"label", assessment_.labels[k]},
           {"choice", m.choice},
           {"run", members_.runs[m.run].hash},
           {"status", q.status},
           {"message", q.message},
           {"wall_seconds", q.wall},
           {"cpu_seconds", q.cpu},
           {"memory_bytes", q.memory},
           {"particles", q.particles},
           {"steps", q.steps}};
    for (size_t r = 0; r < study_.results.size(); ++r) {
      const Taken& t = assessment_.results[r].taken[k];
      j["results"][study_.results[r].name] = {{"value", number(t.value)}, {"error", number(t.error)}};
    }
    return j;
  }

  Json result(size_t r) const {
    const ResultReport& report = assessment_.results[r];
    Json j{{"name", study_.results[r].name},
           {"column", study_.results[r].column},
           {"unit", unit(r)},
           {"reference", report.reference},
           {"front", report.front}};
    j["limits"] = Json::array();
    for (const std::optional<Consensus>& l : report.limits)
      j["limits"].push_back(l ? Json{{"value", l->value}, {"spread", l->spread}, {"methods", l->count}}
                              : Json(nullptr));
    j["settings"] = Json::array();
    for (size_t k = 0; k < report.points.size(); ++k)
      j["settings"].push_back({{"cost", number(report.points[k].cost)},
                               {"error", number(report.points[k].error)},
                               {"settled_error", number(report.settled[k].error)}});
    j["fits"] = Json::array();
    for (const MethodFit& f : report.fits)
      j["fits"].push_back({{"order", number(f.order)}, {"cost", number(f.cost)}});
    j["cheapest"] = Json::array();
    for (const double tolerance : tolerances) {
      const std::optional<size_t> k = cheapest(report.settled, tolerance);
      j["cheapest"].push_back({{"within", tolerance}, {"setting", k ? Json(*k) : Json(nullptr)}});
    }
    return j;
  }

  Json left_out() const {
    Json list = Json::array();
    for (const LeftOutReport& l : report_left_out(study_, members_, records_, assessment_)) {
      Json changes = Json::object();
      for (size_t r = 0; r < l.changes.size(); ++r)
        changes[study_.results[r].name] = number(l.changes[r]);
      list.push_back({{"name", l.name}, {"cost", number(l.cost)}, {"changes", changes}});
    }
    return list;
  }

  const Study& study_;
  const Members& members_;
  const std::vector<Record>& records_;
  const Assessment& assessment_;
};

}  // namespace

std::vector<LeftOutReport> report_left_out(const Study& study, const Members& members,
                                           const std::vector<Record>& records, const Assessment& assessment) {
  std::vector<LeftOutReport> list;
  std::optional<size_t> whole;
  for (size_t k = 0; k < members.members.size(); ++k) {
    const Member& m = members.members[k];
    if (m.left_out == "nothing")
      whole = k;
    else if (!m.left_out.empty() && whole) {
      const double with = middle(records[members.members[*whole].run].wall), without = middle(records[m.run].wall);
      LeftOutReport l{m.left_out, records[m.run].done() ? 1 - without / with : middle({}), {}};
      for (size_t r = 0; r < study.results.size(); ++r) {
        const double before = assessment.results[r].taken[*whole].value, after = assessment.results[r].taken[k].value;
        l.changes.push_back((after - before) / std::abs(before));
      }
      list.push_back(std::move(l));
    }
  }
  return list;
}

void refuse_to_remove_study(const std::filesystem::path& folder, const Study& study) {
  std::ifstream in(folder / json_name);
  const Json j = Json::parse(in, nullptr, false);
  if (!j.is_object())
    return;
  const auto text_of = [&](const char* key, const std::string& otherwise) {
    return j.contains(key) && j[key].is_string() ? j[key].get<std::string>() : otherwise;
  };
  const std::string name = text_of("study", study.name), scene = text_of("scene", study.scene);
  const auto told = [](const std::string& a, const std::string& b) { return shown(a) + ", of scene " + shown(b); };
  if (name != study.name || scene != study.scene)
    fail({Exit::file, "this folder holds the results of another study", folder.string(), told(name, scene),
          "a folder that is new, or holds results of " + told(study.name, study.scene),
          "-o names another folder, or remove this one"});
}

void write_study(const std::filesystem::path& folder, const Study& study, const Members& members,
                 const std::vector<Record>& records, const Assessment& assessment) {
  const Writer writer(study, members, records, assessment);
  write_file(folder / "study.csv", writer.csv());
  write_file(folder / json_name, writer.json().dump(2) + "\n");
}

}  // namespace riven::study
