// Operations are counted as they are: instruction by instruction, and for a program whose work is known by heart.
#include "perf/operations.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace riven::perf {
namespace {

struct Line {
  const char* text;
  int flops, access;
};

TEST(Operations, AreReadFromDisassembledInstructions) {
  constexpr int stack = 8;  // where no size is named
  const Line lines[] = {
      {"vaddpd zmm0,zmm1,zmm2", 8, stack},
      {"vaddpd ymm0,ymm1,YMMWORD PTR [rax+rcx*8+0x20]", 4, 32},
      {"vsubps ymm0,ymm1,ymm2", 8, stack},
      {"vmulsd xmm0,xmm1,QWORD PTR [rip+0x5baafc]        # 715480 <_ZTSymm+0x2>", 1, 8},
      {"mulss  xmm0,DWORD PTR [rsp]", 1, 4},
      {"divpd  xmm3,xmm4", 2, stack},
      {"vsqrtpd xmm0,XMMWORD PTR [rdi]", 2, 16},
      {"vhaddpd ymm0,ymm1,ymm1", 4, stack},
      {"vaddsubpd xmm0,xmm1,xmm2", 2, stack},
      {"vfmadd231pd ymm0,ymm1,ymm2", 8, 8},
      {"vfmadd231pd ymm0,ymm1,YMMWORD PTR [rax]", 8, 8},  // each lane is a read of its own in valgrind
      {"vfnmsub132sd xmm0,xmm1,QWORD PTR [rax]", 2, 8},
      {"vfmaddsub213ps xmm0,xmm1,xmm2", 8, 4},
      // whole numbers, logic, comparisons, roundings, conversions and moves are no flops
      {"vpaddd ymm0,ymm1,ymm2", 0, stack},
      {"vpsubq ymm0,ymm1,YMMWORD PTR [rax]", 0, 32},
      {"add    DWORD PTR [rax],0x1", 0, 4},
      {"imul   rax,rcx", 0, stack},
      {"vandpd ymm0,ymm1,ymm2", 0, stack},
      {"vmaxpd ymm0,ymm1,ymm2", 0, stack},
      {"vcmpltpd ymm0,ymm1,ymm2", 0, stack},
      {"vroundpd ymm0,ymm1,0x9", 0, stack},
      {"vcvtps2pd ymm0,xmm1", 0, stack},
      {"vmovupd YMMWORD PTR [rsp+0x40],ymm0", 0, 32},
      {"vmovsd xmm0,QWORD PTR [rax]", 0, 8},
      {"vbroadcastsd ymm0,QWORD PTR [rax]", 0, 8},
      {"movzx  eax,BYTE PTR [rdi]", 0, 1},
      {"mov    WORD PTR [rdi],ax", 0, 2},
      {"fld    TBYTE PTR [rsp]", 0, 10},
      {"rep movs BYTE PTR es:[rdi],BYTE PTR ds:[rsi]", 0, 1},
      {"push   rbp", 0, 8},
      {"ret", 0, 8},
  };
  for (const Line& line : lines) {
    EXPECT_EQ(classify(line.text).flops, line.flops) << line.text;
    EXPECT_EQ(classify(line.text).access, line.access) << line.text;
  }
}

#ifdef RIVEN_KNOWN_WORK
TEST(Operations, OfAProgramWhoseWorkIsKnownAreCountedExactly) {
  const std::vector<TaskOperations> tasks = count_operations({RIVEN_KNOWN_WORK}, 128 << 10);
  ASSERT_EQ(tasks.size(), 3U);
  const auto of = [&](size_t t, const char* label) {
    EXPECT_EQ(tasks[t].label, label);
    return tasks[t].operations;
  };
  constexpr double call = 0.01;  // what goes with calling a function, spread over its items
  const Operations triad = of(0, "triad"), update = of(1, "update"), compare = of(2, "compare");
  EXPECT_EQ(triad.flops, 2);
  EXPECT_NEAR(triad.moved, 16 + 8, call);
  EXPECT_NEAR(triad.traffic, 16 + 8, call);  // what is only written over is not fetched, but is written back
  EXPECT_EQ(update.flops, 2);
  EXPECT_NEAR(update.moved, 8 + 8, call);
  EXPECT_NEAR(update.traffic, 8 + 8, call);
  EXPECT_EQ(compare.flops, 0);
  EXPECT_NEAR(compare.moved, 16, call);
  EXPECT_NEAR(compare.traffic, 0, call);
}

TEST(Operations, OfAProgramThatIsMissingCannotBeCounted) {
  try {
    count_operations({"no_such_program"}, 1 << 20);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::file);
  }
}
#endif

}  // namespace
}  // namespace riven::perf
