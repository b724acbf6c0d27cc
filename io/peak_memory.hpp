// How much memory a run has taken.
#pragma once

namespace riven {

/// The most memory that this process has held so far, bytes: what the system counts as resident, program and libraries
/// included.
long peak_memory();

}  // namespace riven
