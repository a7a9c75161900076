// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>

namespace exemplar::python {

/// Does `work` on a thread of its own, and returns at once. Threads are kept for the calls that
/// follow, as many as ever worked at the same time: oneTBB 2021.8 does not give back what it
/// remembers of a thread that has ended, 9 KB for each that ran a loop.
///
/// `work` must not throw. `process` is the number of this process: after a fork, whose child has no
/// threads but the one that forked, it begins anew. Called with the interpreter's lock held.
void onAWorker(std::function<void()> work, long process);

}  // namespace exemplar::python
