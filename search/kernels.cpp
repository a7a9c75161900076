// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/kernels.h"

#define EXEMPLAR_KERNELS baseline
#define EXEMPLAR_KERNELS_NAME "baseline"
#include "search/kernels_impl.h"

namespace exemplar::kernels {

#if defined(EXEMPLAR_X86_KERNELS)
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}
#endif

namespace {

struct Available {
  const Kernels* all[3] = {&baseline::kKernels};
  int count = 1;

  Available() {
#if defined(EXEMPLAR_X86_KERNELS)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) all[count++] = &avx2::kKernels;
    if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
      all[count++] = &avx512::kKernels;
#endif
  }
};

const Available& available() {
  static const Available there;
  return there;
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& fastest = *available().all[available().count - 1];
  return fastest;
}

const Kernels* const* availableKernels(int& count) {
  count = available().count;
  return available().all;
}

}  // namespace exemplar::kernels
