#include "core/scene/scene.hpp"

namespace riven {

std::string place(const Scene& s, const std::string& key) {
  const auto found = s.places.find(key);
  return found != s.places.end() ? found->second : s.source_path.empty() ? key : s.source_path + ": " + key;
}

}  // namespace riven
