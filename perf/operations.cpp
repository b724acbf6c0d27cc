#include "perf/operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "perf/callgrind.hpp"

namespace riven::perf {

namespace fs = std::filesystem;

namespace {

constexpr long line_bytes = 64;
/// Share of the instructions that may be missing in objdump's listing: those that the kernel maps into every program.
constexpr double unknown_limit = 0.001;

bool holds(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Bytes of the widest vector register that is named.
int operand_bytes(std::string_view operands) {
  return holds(operands, "zmm") ? 64 : holds(operands, "ymm") ? 32 : 16;
}

/// Flops of each lane of an operation named without its leading v and its type.
int flops_of(std::string_view operation) {
  static constexpr std::array<std::string_view, 8> single{"add", "sub", "mul", "div", "sqrt", "hadd", "hsub", "addsub"};
  static constexpr std::array<std::string_view, 6> fused{"fmadd", "fmsub", "fnmadd", "fnmsub", "fmaddsub", "fmsubadd"};
  if (std::find(single.begin(), single.end(), operation) != single.end())
    return 1;
  constexpr size_t order = 3;  // digits that say which operand is which
  if (operation.size() <= order)
    return 0;
  return std::find(fused.begin(), fused.end(), operation.substr(0, operation.size() - order)) != fused.end() ? 2 : 0;
}

int access_of(std::string_view operands) {
  static constexpr std::array<std::pair<std::string_view, int>, 8> sizes{{{"ZMMWORD PTR", 64},
                                                                          {"YMMWORD PTR", 32},
                                                                          {"XMMWORD PTR", 16},
                                                                          {"TBYTE PTR", 10},
                                                                          {"QWORD PTR", 8},
                                                                          {"DWORD PTR", 4},
                                                                          {"BYTE PTR", 1},
                                                                          {"WORD PTR", 2}}};  // part of most others
  for (const auto& [name, bytes] : sizes)
    if (holds(operands, name))
      return bytes;
  return Instruction{}.access;  // the stack's, in calls and returns
}

/// The instructions of a program or library by address.
class Listing {
 public:
  explicit Listing(const fs::path& object) {
    const ScratchFolder scratch;
    const fs::path file = scratch.path() / "listing";
    run_command({"objdump", "--disassemble", "--no-show-raw-insn", "-M", "intel", object.string()}, file);
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {  // "  4011d6:\tpush   rbp"
      const size_t colon = line.find(":\t"), digits = line.find_first_not_of(' ');
      std::uint64_t address = 0;
      if (colon == std::string::npos ||
          std::from_chars(line.data() + digits, line.data() + colon, address, 16).ptr != line.data() + colon)
        continue;
      all_.push_back({address, classify(std::string_view(line).substr(colon + 2))});
    }
    std::sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  const Instruction* at(std::uint64_t address) const {
    const auto i =
        std::lower_bound(all_.begin(), all_.end(), address, [](const auto& x, auto key) { return x.first < key; });
    return i == all_.end() || i->first != address ? nullptr : &i->second;
  }

 private:
  std::vector<std::pair<std::uint64_t, Instruction>> all_;
};

/// Adds up dumps that name instructions by their addresses.
class Adder {
 public:
  void add(const Dump& dump) {
    auto t = std::find_if(tasks_.begin(), tasks_.end(), [&](const TaskOperations& x) { return x.label == dump.task; });
    if (t == tasks_.end())
      t = tasks_.insert(tasks_.end(), {dump.task, {}});
    Operations sum;
    std::ifstream in(dump.file);
    std::string line;
    std::vector<std::string> events;
    const Listing* listing = nullptr;
    while (std::getline(in, line)) {
      if (line.rfind("events: ", 0) == 0)
        events = words(line.substr(line.find(' ')));
      else if (line.rfind("ob=", 0) == 0)
        listing = listing_of(line.substr(3));
      else if (line.rfind("calls=", 0) == 0)
        std::getline(in, line);  // what the callee did, which is listed there, too
      else if (line.rfind("0x", 0) == 0)
        add(line, events, listing, sum);
    }
    sum.instructions /= dump.particle_steps;
    sum.flops /= dump.particle_steps;
    sum.moved /= dump.particle_steps;
    sum.traffic /= dump.particle_steps;
    t->operations += sum;
  }
  std::vector<TaskOperations> result() const {
    if (unknown_ > unknown_limit * known_)
      fail({Exit::internal, "instructions that callgrind counts are missing in objdump's listing", "operations",
            fmt::format("{} of {}", unknown_, known_ + unknown_), fmt::format("{} %", 100 * unknown_limit)});
    return tasks_;
  }

 private:
  static std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> list;
    for (std::string word; in >> word;)
      list.push_back(word);
    return list;
  }
  const Listing* listing_of(const std::string& object) {
    auto known = listings_.find(object);
    if (known == listings_.end() && fs::exists(object))
      known = listings_.emplace(object, object).first;
    return known == listings_.end() ? nullptr : &known->second;
  }
  /// "0x4011d6 10 10 0 0 5": an address and how often each event met it, those at the end left out where they are 0.
  void add(const std::string& line, const std::vector<std::string>& events, const Listing* listing, Operations& sum) {
    std::istringstream in(line);
    std::string address;
    in >> address;
    double ran = 0, accesses = 0, lines = 0;
    for (const std::string& event : events) {
      double n = 0;
      if (!(in >> n))
        break;
      if (event == "Ir")
        ran = n;
      else if (event == "Dr" || event == "Dw")
        accesses += n;
      else if (event == "DLmr" || event == "DLdmr" || event == "DLdmw")  // fetched; written back by a read, a write
        lines += n;
    }
    sum.instructions += ran;
    sum.traffic += line_bytes * lines;
    const Instruction* i = listing ? listing->at(std::stoull(address, nullptr, 16)) : nullptr;
    (i ? known_ : unknown_) += ran;
    if (!i)
      return;
    sum.flops += ran * i->flops;
    sum.moved += accesses * i->access;
  }

  std::vector<TaskOperations> tasks_;
  std::map<std::string, Listing> listings_;
  double known_ = 0, unknown_ = 0;
};

/// callgrind's name for a cache of about so many bytes: it wants a power of two of sets.
std::string geometry(long bytes) {
  constexpr long least_ways = 16;
  const long lines = bytes / line_bytes;
  const long sets = static_cast<long>(std::bit_floor(static_cast<std::uint64_t>(std::max(1L, lines / least_ways))));
  const long ways = std::max(1L, lines / sets);
  return fmt::format("{},{},{}", sets * ways * line_bytes, ways, line_bytes);
}

}  // namespace

Operations& Operations::operator+=(const Operations& o) {
  instructions += o.instructions;
  flops += o.flops;
  moved += o.moved;
  traffic += o.traffic;
  return *this;
}

Instruction classify(std::string_view text) {
  text = text.substr(0, text.find('#'));  // where an address relative to the instruction points to
  const size_t space = text.find(' ');
  std::string_view name = text.substr(0, space);
  const std::string_view operands = space == std::string_view::npos ? "" : text.substr(space);
  Instruction i{0, access_of(operands)};
  if (name.substr(0, 1) == "v")
    name.remove_prefix(1);
  constexpr size_t type_letters = 2;
  if (name.size() <= type_letters)
    return i;
  const std::string_view type = name.substr(name.size() - type_letters);
  int lanes = 0;
  if (type == "sd" || type == "ss")
    lanes = 1;
  else if (type == "pd" || type == "ps")
    lanes = operand_bytes(operands) / static_cast<int>(type == "pd" ? sizeof(double) : sizeof(float));
  const int each = flops_of(name.substr(0, name.size() - type_letters));
  i.flops = lanes * each;
  if (each == 2)  // valgrind reads what a fused multiply-add finds in memory lane by lane
    i.access = static_cast<int>(name.back() == 'd' ? sizeof(double) : sizeof(float));
  return i;
}

long last_level_cache() {
  long bytes = 32L << 20;  // where the system does not say
  for (int index = 0;; ++index) {
    std::ifstream in(fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/size", index));
    long kib = 0;
    if (!(in >> kib))
      return bytes;
    bytes = kib << 10;  // "32768K", the caches in order of level
  }
}

std::vector<TaskOperations> count_operations(const std::vector<std::string>& command, long cache) {
  const ScratchFolder scratch;
  const std::vector<std::string> options{
      "--dump-instr=yes",
      "--dump-line=no",
      "--compress-strings=no",
      "--compress-pos=no",
      "--cache-sim=yes",
      "--simulate-wb=yes",
      "--LL=" + geometry(cache),
      "--log-file=" + (scratch.path() / "log").string()};  // it warns of caches that are not as it would have them
  Adder adder;
  run_callgrind(options, command, [&](const Dump& dump) { adder.add(dump); });
  return adder.result();
}

}  // namespace riven::perf
