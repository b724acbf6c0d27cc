#include "io/compare_scenes.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "io/suggest.hpp"
#include "io/toml.hpp"
#include "io/toml_text.hpp"

namespace riven {

namespace {

constexpr const char* may_change[] = {"solver.time", "solver.threads", "solver.exec", "output"};
constexpr size_t most_named = 5;

struct Difference {
  std::string key, before, now;
};

std::string value_text(const toml::node* node) {
  return node ? shown(toml_value(*node)) : "not said";
}

bool free_to_change(const std::string& path) {
  return std::find(std::begin(may_change), std::end(may_change), path) != std::end(may_change);
}

void compare(const toml::node* a, const toml::node* b, const std::string& path, std::vector<Difference>& list) {
  const auto below = [&](std::string_view key) { return (path.empty() ? "" : path + ".") + std::string(key); };
  if (free_to_change(path) || (a && b && toml_value(*a) == toml_value(*b)))
    return;
  const toml::table *s = a ? a->as_table() : nullptr, *t = b ? b->as_table() : nullptr;
  const toml::array *p = a ? a->as_array() : nullptr, *q = b ? b->as_array() : nullptr;
  if (s && t) {
    for (const auto& [key, node] : *s)
      compare(&node, t->get(key.str()), below(key.str()), list);
    for (const auto& [key, node] : *t)
      if (!s->contains(key.str()))
        compare(nullptr, &node, below(key.str()), list);
  } else if (p && q && p->size() == q->size()) {
    for (size_t i = 0; i < p->size(); ++i)
      compare(p->get(i), q->get(i), below(std::to_string(i)), list);
  } else if (s && !b) {  // what is said there may all be free to change
    for (const auto& [key, node] : *s)
      compare(&node, nullptr, below(key.str()), list);
  } else if (t && !a) {
    for (const auto& [key, node] : *t)
      compare(nullptr, &node, below(key.str()), list);
  } else {
    list.push_back({path, value_text(a), value_text(b)});
  }
}

}  // namespace

void require_same_scene(const Scene& before, const Scene& now) {
  const toml::table a = parse_toml(before.source_text, before.source_path),
                    b = parse_toml(now.source_text, now.source_path);
  std::vector<Difference> list;
  compare(&a, &b, "", list);
  for (const auto& [name, content] : before.files)
    if (const auto found = now.files.find(name); found != now.files.end() && found->second != content)
      list.push_back({"file " + name, "as in the checkpoint", "other contents"});
  if (list.empty())
    return;
  std::string keys, values;
  for (size_t i = 0; i < list.size(); ++i) {
    if (i == most_named) {
      keys += " and " + std::to_string(list.size() - i) + " more";
      break;
    }
    keys += (i ? ", " : "") + list[i].key;
    values += (i ? "; " : "") + list[i].key + " = " + list[i].now + ", in the checkpoint " + list[i].before;
  }
  fail({Exit::bad_input, "the scene is not the one that the run began with: " + keys, now.source_path, values,
        "other values of " + listed({std::begin(may_change), std::end(may_change)}) + " only",
        "the same scene, or a new run without --restart"});
}

}  // namespace riven
