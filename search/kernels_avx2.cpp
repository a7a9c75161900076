// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#define EXEMPLAR_KERNELS avx2
#define EXEMPLAR_KERNELS_NAME "AVX2"
#include "search/kernels_impl.h"
