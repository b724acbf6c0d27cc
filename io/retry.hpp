// A run that went wrong and went back: what stands about it in summary.json and in checkpoints.
#pragma once
#include <string>

namespace riven {

struct Retry {
  long step = 0;        ///< after so many steps it went wrong
  double time = 0;      ///< s
  long back_to = 0;     ///< step from which it went on
  double cfl = 0;       ///< CFL number from there on
  std::string message;  ///< what went wrong
};

}  // namespace riven
