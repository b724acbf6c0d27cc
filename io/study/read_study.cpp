#include "io/study/read_study.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "io/keys.hpp"
#include "io/text_file.hpp"

namespace riven::study {

namespace {

/// TOML of a value as people name it: texts without their quotes.
std::string label_of(const std::string& value) {
  return value.size() > 1 && value.front() == '"' ? value.substr(1, value.size() - 2) : value;
}

/// The number, or the length or time in SI, that the text says; nothing when it is neither.
std::optional<double> size_of(const std::string& text) {
  if (const std::optional<double> number = plain_number(text))
    return number;
  for (const Dimension* d : {&dimension::length, &dimension::time})
    try {
      return parse_quantity(text, *d);
    } catch (const Error&) {
      continue;  // perhaps the other
    }
  return std::nullopt;
}

void read_size(const Table& t, const char* key, const std::string& text, Choice& c) {
  const std::optional<double> size = size_of(text);
  if (!size || !(*size > 0))
    t.refuse(key, fmt::format("'{}' has no size that could tend to zero", shown(text)),
             "numbers, lengths or times greater than 0", "say size = ... in a [[vary.choice]] of its own");
  c.size = *size;
}

Axis read_axis(const Table& t) {
  Axis axis;
  axis.refined = t.flag("refined", false);
  axis.problem = t.flag("problem", false);
  if (axis.refined && axis.problem)
    t.refuse("problem", "an axis of problems is not refined: errors are fitted for each of them", "one of the two");
  if (t.has("key") == t.has("choice"))
    t.refuse("choice", "an axis has either a key with values or choices", "key and values, or [[vary.choice]]");
  if (t.has("key")) {
    const std::string key = t.text("key");
    axis.name = t.text("name", key);
    for (const std::string& value : t.values("values")) {
      Choice c{label_of(value), {fmt::format("{}={}", key, value)}};
      if (axis.refined)
        read_size(t, "values", c.label, c);
      axis.choices.push_back(std::move(c));
    }
  } else {
    axis.name = t.text("name");
    for (const Table& entry : t.tables("choice", {"label", "set", "size"})) {
      Choice c{entry.text("label"), entry.texts("set")};
      if (axis.refined)
        read_size(entry, "size", label_of(entry.value("size")), c);
      axis.choices.push_back(std::move(c));
    }
  }
  const char* list = t.has("key") ? "values" : "choice";
  if (axis.choices.empty())
    t.refuse(list, "the axis has no choice", "one at least");
  for (const Choice& c : axis.choices)
    if (std::count_if(axis.choices.begin(), axis.choices.end(), [&](const Choice& o) { return o.label == c.label; }) >
        1)
      t.refuse(list, fmt::format("two choices are called '{}'", shown(c.label)), "a name of its own for each");
  return axis;
}

Take read_take(const Table& t) {
  static const std::vector<std::string> names{"end", "mean", "rms", "largest", "smallest"};
  return static_cast<Take>(t.one_of("take", names, 0));
}

/// An entry for each problem, of a list that has one for each or for all.
template <class T>
std::vector<T> for_each_problem(const Table& t, const char* key, std::vector<T> list, const Study& s) {
  if (list.size() == 1)
    list.resize(s.problems(), list.front());
  if (list.size() != s.problems())
    t.refuse(key, fmt::format("the list has {} entries", list.size()),
             s.problem() ? fmt::format("one for each of the {} choices of {}, or one for all", s.problems(),
                                       s.axes[*s.problem()].name)
                         : "one: there is no [[vary]] with problem = true");
  return list;
}

/// The texts at `key`, one for each problem; empty ones when it is absent.
std::vector<std::string> texts_of(const Table& t, const char* key, const Study& s) {
  std::vector<std::string> list{""};
  if (t.has(key)) {
    list = t.one_or_more(key);
    for (std::string& value : list) {
      const char first = value.front();
      if (first == '[' || first == '{' || value == "true" || value == "false")
        t.refuse(key, fmt::format("expected a text or a number, found {}", shown(value)), "one, or a list of them");
      value = label_of(value);
    }
  }
  return for_each_problem(t, key, std::move(list), s);
}

std::vector<double> times_of(const Table& t, const char* key, Range allowed, double fallback, const Study& s) {
  const std::vector<double> list =
      t.has(key) ? t.quantities(key, dimension::time, allowed) : std::vector<double>{fallback};
  return for_each_problem(t, key, list, s);
}

std::vector<Target> read_targets(const Table& t, const Study& s) {
  if (t.has("curve") && t.has("reference"))
    t.refuse("curve", "a result has either a curve or a reference", "one of the two");
  const std::filesystem::path folder = std::filesystem::path(s.path).parent_path();
  const std::vector<double> from = times_of(t, "from", range::non_negative, 0, s),
                            to = times_of(t, "to", range::positive, std::numeric_limits<double>::max(), s);
  const std::vector<std::string> curve = texts_of(t, "curve", s), value = texts_of(t, "reference", s),
                                 scale = texts_of(t, "scale", s);
  std::vector<Target> targets;
  for (size_t p = 0; p < s.problems(); ++p) {
    Target target{from[p], to[p], {}, scale[p], t.where()};
    if (s.problem())
      target.where += fmt::format(", {} {}", s.axes[*s.problem()].name, s.axes[*s.problem()].choices[p].label);
    if (to[p] < from[p])
      t.refuse("to", "the window ends before it begins", "a time after from");
    if (t.has("curve")) {
      target.reference = {Reference::Kind::curve, "", (folder / curve[p]).string()};
      if (!std::filesystem::is_regular_file(target.reference.file))
        t.refuse("curve", fmt::format("there is no file {}", shown(target.reference.file)),
                 "files of two columns, relative to the study's folder");
    }
    if (t.has("reference"))
      target.reference = {value[p] == "extrapolated" ? Reference::Kind::extrapolated : Reference::Kind::value, value[p],
                          ""};
    targets.push_back(std::move(target));
  }
  return targets;
}

Result read_result(const Table& t, const Study& s) {
  Result r;
  r.column = t.text("column");
  r.name = t.text("name", r.column);
  r.take = read_take(t);
  r.targets = read_targets(t, s);
  if (t.has("curve")) {
    if (t.has("take"))
      t.refuse("take", "a curve is compared over the whole window", "no take beside curve");
    r.take = Take::curve;
  }
  return r;
}

void read_timing(const Table& root, Study& s) {
  const Table t = root.table("timing", {"take", "repeats", "repeat_under", "threads"});
  s.timing = t.flag("take", s.timing);
  s.repeats = t.integer("repeats", 1, 100, s.repeats);
  s.repeat_under = t.quantity("repeat_under", dimension::time, range::non_negative, s.repeat_under);
  s.threads = t.integer("threads", 0, 1024, s.threads);
}

void check_names(const Table& root, const Study& s) {
  std::vector<std::string> axes, results;
  for (const Axis& a : s.axes)
    axes.push_back(a.name);
  for (const Result& r : s.results)
    results.push_back(r.name);
  for (const auto& [key, names] : {std::pair{"vary", axes}, {"result", results}})
    for (const std::string& n : names)
      if (std::count(names.begin(), names.end(), n) > 1)
        root.refuse(key, fmt::format("two of them are called '{}'", shown(n)), "a name of its own for each");
}

void check(const Table& root, const Study& s) {
  if (s.axes.empty() && s.left_out.empty())
    root.refuse("vary", "there is nothing to study", "at least one [[vary]], or [[leave_out]]");
  if (s.results.empty())
    root.refuse("result", "the study has no result", "at least one [[result]] with a column of history.csv");
  check_names(root, s);
}

void check_axes(const Table& root, const Study& s) {
  const auto several = [&](bool Axis::*kind) {
    return std::count_if(s.axes.begin(), s.axes.end(), [&](const Axis& a) { return a.*kind; }) > 1;
  };
  if (several(&Axis::refined))
    root.refuse("vary", "several axes are refined", "refined = true in one [[vary]]");
  if (several(&Axis::problem))
    root.refuse("vary", "several axes are problems", "problem = true in one [[vary]]",
                "one axis whose [[vary.choice]] set what makes each problem");
}

/// What has to be known of the whole study: curves are fitted, and extrapolated, along a refined axis.
void check_references(const Table& t, const Study& s, const Result& r) {
  for (const Target& target : r.targets) {
    const Reference::Kind kind = target.reference.kind;
    if (!s.axes.empty() && kind == Reference::Kind::none)
      t.refuse("reference", "the result has no reference",
               "a quantity, \"extrapolated\", or curve = a file of two columns", "reference = \"13.4 kJ/m^2\"");
    if (kind == Reference::Kind::extrapolated && (!s.refined() || s.axes[*s.refined()].choices.size() < 3))
      t.refuse("reference", "nothing can be extrapolated", "a [[vary]] with refined = true and three choices or more");
  }
}

}  // namespace

Study parse_study(std::string_view text, const std::string& path) {
  const toml::table document = parse_toml(text, path);
  Scene places;  // remembers where things were written
  places.source_path = path;
  const Table root(document, places, {"title", "scene", "set", "timing", "vary", "result", "leave_out"});
  Study s;
  s.path = path;
  s.name = std::filesystem::path(path).stem().string();
  s.title = root.text("title", s.name);
  s.scene = root.text("scene");
  s.set = root.texts("set");
  read_timing(root, s);
  for (const Table& t : root.tables("vary", {"name", "key", "values", "choice", "refined", "problem"}))
    s.axes.push_back(read_axis(t));
  check_axes(root, s);
  for (const Table& t : root.tables("leave_out", {"name", "set"}))
    s.left_out.push_back({t.text("name"), t.texts("set")});
  const std::vector<Table> results =
      root.tables("result", {"name", "column", "take", "from", "to", "reference", "curve", "scale", "source"});
  for (const Table& t : results)
    s.results.push_back(read_result(t, s));
  check(root, s);
  for (size_t k = 0; k < results.size(); ++k)
    check_references(results[k], s, s.results[k]);
  return s;
}

Study read_study(const std::string& path) {
  return parse_study(read_text_file(path, "the study"), path);
}

}  // namespace riven::study
