// The nearest valid name to one that is not known, for error messages.
#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace riven {

/// Number of insertions, deletions, substitutions and swaps of neighbours between two words, case ignored
/// (optimal string alignment).
inline size_t edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char p, char q) {
    return std::tolower(static_cast<unsigned char>(p)) == std::tolower(static_cast<unsigned char>(q));
  };
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The known name closest to `word`; empty when none is close enough to be what was meant.
inline std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  constexpr size_t longest = 64;  // nothing in a scene has a longer name
  if (word.empty() || word.size() > longest)
    return {};
  std::string best;
  size_t least = std::max<size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& name : known) {
    if (name.size() > longest)
      continue;
    const size_t d = edit_distance(word, name);
    if (d < least)
      least = d, best = name;
  }
  return best;
}

/// "a, b, c".
inline std::string listed(const std::vector<std::string>& names) {
  std::string s;
  for (const std::string& n : names)
    s += (s.empty() ? "" : ", ") + n;
  return s;
}

/// Text as it may be shown in a terminal: control characters replaced, long text cut.
inline std::string shown(std::string_view text) {
  constexpr size_t longest = 120;
  std::string s(text.substr(0, longest));
  for (char& c : s)
    if (std::iscntrl(static_cast<unsigned char>(c)))
      c = ' ';
  return text.size() > longest ? s + "..." : s;
}

}  // namespace riven
