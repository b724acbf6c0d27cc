// The commands of riven-perf. Each adds itself, with its options and what it does, to the program.
#pragma once

namespace CLI {
class App;
}

namespace riven::perf {

/// `riven-perf machine`: bandwidths and rates of this machine for each core count.
void add_machine(CLI::App& app);
/// `riven-perf throughput`: particle-steps per second of whole steps, and what cracks cost.
void add_throughput(CLI::App& app);
/// `riven-perf kernels`: time of each task beside the machine's roofline.
void add_kernels(CLI::App& app);
/// `riven-perf gate`: fails when a scene takes more instructions or time than its baseline allows.
void add_gate(CLI::App& app);

}  // namespace riven::perf
