// Traces the particles of marked tiles that may have come to cross something else.
#pragma once
#if defined(RIVEN_ON_DEVICE)
#include "kernels/trace_tiles_on_device.hpp"
#else
#include "kernels/trace_tiles_on_host.hpp"
#endif
