// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "core/error.h"

namespace exemplar::test {

/// The message of the `InputError` that `work` throws; "no error" where it throws none.
template <class Work>
std::string errorOf(const Work& work) {
  try {
    (void)work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace exemplar::test
