// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

/// Marks a hot function whose loops the compiler vectorizes: it is compiled once for every x86-64
/// and again for AVX2 and AVX-512, and the machine picks at load time. Elsewhere (arm64, where
/// NEON is always there; sanitizers, which start before load-time choices work) it is compiled
/// once. Results are the same bytes in each version: the build allows no fused multiply-add and no
/// reordering of floating-point sums, so write sums over explicit lanes where they should vectorize.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define EXEMPLAR_MULTIVERSION \
  __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define EXEMPLAR_MULTIVERSION
#endif
