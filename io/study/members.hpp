// The members of a study, and the runs that serve them.
#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "io/study/study.hpp"

namespace riven::study {

/// One run of the program. J has no part in the motion of cracks that do not grow, so that members which differ only in
/// how J is found share one.
struct Run {
  std::string label;
  std::vector<std::string> set;  ///< on top of the scene, as for `riven run --set`
  std::string hash;      ///< of the scene with these settings and its files, the number of threads and this program
  double work = 0;       ///< particles times steps, about
  std::string refused;   ///< why the scene cannot be run with these settings; else empty
  double particles = 0;  ///< about
};

struct Member {
  std::vector<size_t> choice;  ///< of each axis; empty where something is left out
  size_t run = 0;
  std::string reading;   ///< of the run whose J and K are meant; empty: those of the scene's own rules
  std::string left_out;  ///< name of what is left out, or "nothing" for what that is held against
};

struct Members {
  std::vector<Run> runs;
  std::vector<Member> members;
};

/// All combinations of the choices, the first axis slowest, then what is left out. `scene`: the file. Throws Error
/// (bad_input) where a setting cannot be right in any of its combinations, as with an unknown key.
Members expand(const Study& study, const std::string& scene);

/// The column of a result in a run: the column of the reading, where the member has one and it is J's or K's.
std::string column_of(const Member& member, const std::string& column);

}  // namespace riven::study
