// An HDF5 file driver that cannot fail while writing.
//
// When a write fails, HDF5 1.10 can neither close the file nor leave the program without a crash, because its
// caches keep data that never reach the disk. This driver notes the first failure and keeps what follows in
// memory, so that HDF5 always closes in good order; whoever owns the file then looks at the note.
#pragma once
#include <hdf5.h>

namespace riven {

/// A file access list for H5Fcreate that writes to the open descriptor. `failure` receives the errno of the first
/// write that failed; it and the descriptor must outlive the HDF5 file. Close the list with H5Pclose.
hid_t make_driver_list(int descriptor, int* failure);

}  // namespace riven
