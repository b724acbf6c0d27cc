// Walking through the tables of a scene: every key is known, typed, in range and remembered with its place.
#pragma once
#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/names.hpp"
#include "core/scene/scene.hpp"
#include "io/expression.hpp"
#include "io/suggest.hpp"
#include "io/toml.hpp"
#include "io/units.hpp"

namespace riven {

/// Numbers that a key allows; finite ones in any case.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool has(double x) const;
  std::string text(const std::string& unit = {}) const;
};

namespace range {
inline constexpr Range any{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range non_negative{0};
}  // namespace range

/// One table of a scene. Constructing it refuses keys that are not in `known`. The accessors without a fallback refuse
/// a missing key; those with one note "key = fallback" in Scene::defaults. All throw Error (bad_input) that says
/// file, line and key.
class Table {
 public:
  /// The root of a scene.
  Table(const toml::table& root, Scene& scene, std::initializer_list<const char*> known);

  /// A table below this one; an empty one when it is absent, so that its defaults are noted.
  Table table(const char* key, std::initializer_list<const char*> known) const;
  /// Each table of an array of tables ([[key]] or [ {..}, {..} ]).
  std::vector<Table> tables(const char* key, std::initializer_list<const char*> known) const;

  bool has(const char* key) const { return find(key) != nullptr; }
  double number(const char* key, Range allowed) const;
  double number(const char* key, Range allowed, double fallback) const;
  int integer(const char* key, int low, int high, std::optional<int> fallback = {}) const;
  bool flag(const char* key, bool fallback) const;
  std::string text(const char* key) const;
  std::string text(const char* key, const std::string& fallback) const;
  std::vector<std::string> texts(const char* key) const;
  /// Anything, as it would stand in TOML.
  std::string value(const char* key) const;
  /// The items of an array, each likewise.
  std::vector<std::string> values(const char* key) const;
  /// The same, or a single one that does not stand in an array.
  std::vector<std::string> one_or_more(const char* key) const;
  /// A quantity in SI units; `said` is how a fallback is shown when it stands for something else.
  double quantity(const char* key, const Dimension& d, Range allowed) const;
  double quantity(const char* key, const Dimension& d, Range allowed, double fallback,
                  const char* said = nullptr) const;
  /// An array of quantities, or a single one.
  std::vector<double> quantities(const char* key, const Dimension& d, Range allowed) const;
  /// A toughness in Pa m^0.5, greater than 0.
  double toughness(const char* key) const;
  /// Two plain numbers, not both 0, made a vector of unit length.
  Vec2 heading(const char* key) const;
  Vec2 vector(const char* key, const Dimension& d) const;
  Vec2 vector(const char* key, const Dimension& d, Vec2 fallback) const;
  std::vector<Vec2> points(const char* key, size_t least) const;
  /// A quantity or { value = .., shape = .., name = time .. }; empty when the key is absent.
  std::optional<TimeFunction> function(const char* key, const Dimension& d) const;
  /// The same, whose shape may name places, X and Y, and constants of any dimension, or plain numbers.
  std::optional<Field> field(const char* key, const Dimension& d) const;
  /// The table at `key`: each of its keys is a constant that all shapes read from now on may use.
  void constants(const char* key) const;
  /// One of the names in Names<E>.
  template <class E>
  E choice(const char* key, std::optional<E> fallback = {}) const {
    std::vector<std::string> names;
    std::optional<size_t> otherwise;
    for (const auto& [value, name] : Names<E>::table) {
      if (fallback && value == *fallback)
        otherwise = names.size();
      names.emplace_back(name);
    }
    return Names<E>::table[one_of(key, names, otherwise)].first;
  }
  /// Index of the text at `key` in `names`.
  size_t one_of(const char* key, const std::vector<std::string>& names, std::optional<size_t> fallback = {}) const;

  /// "scene.toml:12: body.0.velocity"; without a key, the table itself.
  std::string where(const char* key = nullptr) const;
  /// Remembers this table's place under a name of its own, "crack left", for checks that come later.
  void remember(const std::string& name) const { scene_->places[name] = where(); }
  [[noreturn]] void refuse(const char* key, std::string what, std::string limit = {}, std::string hint = {}) const;

 private:
  Table(const toml::table* table, std::string path, const Table& parent, std::initializer_list<const char*> known);
  const toml::node* find(const char* key) const { return table_->get(key); }
  const toml::node& need(const char* key) const;
  bool absent(const char* key, std::string_view fallback) const;
  void check_known() const;
  std::string path(const char* key) const { return path_.empty() ? key : path_ + "." + key; }
  double quantity_of(const toml::node& node, const char* key, const Dimension& d) const;
  double constant_of(const toml::node& node, const std::string& place) const;
  struct Shaped {
    double value = 0;
    std::string shape, text;
    Constants constants;
  };
  /// `times`: its own constants are times; else they may be anything.
  Shaped shaped(const toml::table& entries, const char* key, const Dimension& d, bool times) const;
  TimeFunction of_time(const Shaped& f, const char* key) const;
  Vec2 vector_of(const toml::node& node, const char* key, const Dimension& d) const;
  double checked(const char* key, double value, Range allowed, const std::string& unit) const;
  [[noreturn]] void wrong_type(const toml::node& node, const char* key, const char* expected) const;
  /// Runs `read`, giving its error this key's place.
  template <class F>
  auto placed(const char* key, F read) const;

  const toml::table* table_;
  std::string path_;
  std::string place_;  ///< "scene.toml:12" of the table's head
  Scene* scene_;
  std::vector<std::string> known_;
};

}  // namespace riven
