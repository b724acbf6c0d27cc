// The program itself, as a user would call it.
#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/io/results_sample.hpp"

namespace riven {

struct Outcome {
  int code;  ///< of exit; -1: killed
  std::string output, errors;
};

/// Runs `riven ARGUMENTS` in a shell, after `before` ("ulimit -v 500000;"). Its output goes to files in the folder.
inline Outcome riven(const std::string& arguments, const sample::Folder& folder, const std::string& before = "") {
  const std::string output = (folder / "output.txt").string(), errors = (folder / "errors.txt").string();
  const std::string line =
      before + " " + std::string(RIVEN_PROGRAM) + " " + arguments + " >'" + output + "' 2>'" + errors + "'";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, sample::text_of(output), sample::text_of(errors)};
}

}  // namespace riven
