// The first bytes of a checkpoint: what it is, for whom, and a digest of all the rest. They are looked at before HDF5
// sees the file, so that a damaged one never gets as far as HDF5.
#pragma once
#include <cstddef>
#include <filesystem>

namespace riven {

inline constexpr std::size_t checkpoint_header_bytes = 512;

/// Of what is stored, and how; another one cannot be read.
inline constexpr int checkpoint_format = 17;

/// Completes and syncs a file whose first bytes are free. `path` names it in messages. Throws Error (file).
void seal_checkpoint(int descriptor, const std::filesystem::path& path);

/// Throws Error (file) unless the file is a checkpoint of this format, whole and as it was written.
void verify_checkpoint(const std::filesystem::path& path);

}  // namespace riven
