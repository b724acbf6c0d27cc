// Faults made on purpose, and the errors that they must give.
#pragma once
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "core/error.hpp"

namespace riven {

/// The message of the Error (file) that `act` must throw, or what went wrong instead.
inline std::string file_error(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& e) {
    return e.code() == Exit::file ? e.what() : "another exit code: " + std::string(e.what());
  }
  return "no error";
}

/// Runs in a process of its own in which no file may grow beyond `bytes`; true when `act` returns true and the
/// process ends in good order.
inline bool with_small_disk(rlim_t bytes, const std::function<bool()>& act) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    bool good = false;
    try {
      good = act();
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
    }
    std::exit(good ? 0 : 1);  // with the clean-up of the HDF5 library
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace riven
